// SPDX-License-Identifier: Apache-2.0
#include "scene/file_fault.h"

namespace luciole {

void fail(const std::string& code, const std::string& object, const std::string& sentence) {
  throw FileFault((object.empty() ? "" : object + ": ") + sentence + " (" + code + ")");
}

std::string printable(const std::string& text) {
  constexpr std::size_t kLongest = 80;
  std::string shown;
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    shown += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  return text.size() > kLongest ? shown + "..." : shown;
}

}  // namespace luciole
