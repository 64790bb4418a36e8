// SPDX-License-Identifier: Apache-2.0
// What Vulkan answers, as the house's Result: one sentence that says what was tried and why it failed.
#pragma once
#include <vulkan/vulkan.h>

#include <string>
#include <vector>

#include "base/result.h"

namespace luciole::gpu {

// "cannot ATTEMPT: WHY"; out of memory keeps its exit code.
Error error_of(VkResult answer, const std::string& attempt);

inline Status checked(VkResult answer, const std::string& attempt) {
  return answer == VK_SUCCESS ? Status(Done{}) : Status(error_of(answer, attempt));
}

// A structure with its type set and all else zero.
template <class Structure>
Structure of_type(VkStructureType type) {
  Structure structure{};
  structure.sType = type;
  return structure;
}

// All elements that a function of Vulkan lists in two calls: count, then values.
template <class Element, class List>
std::vector<Element> listed(const List& list) {
  std::uint32_t count = 0;
  list(&count, static_cast<Element*>(nullptr));
  std::vector<Element> elements(count);
  list(&count, elements.data());
  elements.resize(count);
  return elements;
}

}  // namespace luciole::gpu
