// SPDX-License-Identifier: Apache-2.0
// Text for sentences that a user reads.
#pragma once
#include <string>

namespace luciole {

// "a, b, c" of a range of strings.
template <class Range>
std::string joined(const Range& words) {
  std::string list;
  for (const auto& word : words) {
    if (!list.empty()) list += ", ";
    list += word;
  }
  return list;
}

}  // namespace luciole
