// SPDX-License-Identifier: Apache-2.0
#include "report/html.h"

namespace luciole {

std::string escape_html(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      case '\t':
      case '\n':
        safe += letter;
        break;
      default:
        if (code < 0x20 || code == 0x7f) {
          safe += "\xef\xbf\xbd";  // U+FFFD
        } else {
          safe += letter;
        }
    }
  }
  return safe;
}

std::string shortened(std::string text, std::size_t length) {
  if (text.size() <= length) return text;
  const auto continues = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80; };
  while (length > 0 && continues(length)) --length;
  text.resize(length);
  return text + "...";
}

}  // namespace luciole
