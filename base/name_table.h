// SPDX-License-Identifier: Apache-2.0
// Names of an enumeration's values, written once: the command line, shots, statistics and pictures read them here. An
// enumeration T takes part by `constexpr NameTable<T, count> names(T)` beside it.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace luciole {

template <class T, std::size_t count>
using NameTable = std::array<std::pair<T, std::string_view>, count>;

template <class T>
std::string name_of(T value) {
  for (const auto& [entry, name] : names(value)) {
    if (entry == value) return std::string(name);
  }
  return "unknown";
}

template <class T>
std::optional<T> value_named(std::string_view wanted) {
  for (const auto& [entry, name] : names(T{})) {
    if (name == wanted) return entry;
  }
  return std::nullopt;
}

// "a, b, c": for the sentence that refuses any other name.
template <class T>
std::string all_names() {
  std::string list;
  for (const auto& [entry, name] : names(T{})) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

}  // namespace luciole
