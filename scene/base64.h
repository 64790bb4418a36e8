// SPDX-License-Identifier: Apache-2.0
// RFC 4648 base64, as data URIs carry it.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace luciole {

// Padding may be missing; any other character outside the alphabet (the URL-safe one included), a stray bit or a
// misplaced '=' gives nothing.
std::optional<std::vector<std::uint8_t>> decode_base64(std::string_view text);

}  // namespace luciole
