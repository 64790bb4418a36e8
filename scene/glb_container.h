// SPDX-License-Identifier: Apache-2.0
// The binary glTF container: a 12-byte header, a JSON chunk, perhaps one binary chunk (glTF 2.0, chapter 4).
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace luciole {

struct GlbChunks {
  std::string_view json;
  std::optional<std::span<const std::uint8_t>> binary;
};

bool is_glb(std::span<const std::uint8_t> file);

// Views into `file`. Chunks of unknown kind are skipped; fails with the validator's GLB_ codes.
GlbChunks split_glb(std::span<const std::uint8_t> file);

}  // namespace luciole
