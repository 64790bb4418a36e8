// SPDX-License-Identifier: Apache-2.0
// Text of strangers (file names, metadata) in a page.
#pragma once
#include <string>
#include <string_view>

namespace luciole {

// As text and within quoted attributes. Control characters, which HTML forbids, become U+FFFD; bytes that are not UTF-8
// stay, and a browser shows them as that.
std::string escape_html(std::string_view text);

// At most `length` bytes, "..." behind what was cut, never within a character.
std::string shortened(std::string text, std::size_t length);

}  // namespace luciole
