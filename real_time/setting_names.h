// SPDX-License-Identifier: Apache-2.0
// The names of the settings' values, written once: the command line, shots, statistics and pictures read them here.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "real_time/settings.h"

namespace luciole {

template <class T, std::size_t count>
using NameTable = std::array<std::pair<T, std::string_view>, count>;

constexpr NameTable<BoundingVolume, 4> names(BoundingVolume) {
  return {{{BoundingVolume::sphere_at_light, "sphere-at-light"},
           {BoundingVolume::sphere, "sphere"},
           {BoundingVolume::spheroid, "spheroid"},
           {BoundingVolume::tight, "tight"}}};
}
constexpr NameTable<TileTest, 3> names(TileTest) {
  return {{{TileTest::paper, "paper"}, {TileTest::exact, "exact"}, {TileTest::tight, "tight"}}};
}
constexpr NameTable<Culling, 2> names(Culling) { return {{{Culling::tiled, "tiled"}, {Culling::none, "none"}}}; }
constexpr NameTable<Ranges, 4> names(Ranges) {
  return {{{Ranges::stochastic, "stochastic"},
           {Ranges::clamped, "clamped"},
           {Ranges::clamped_bound, "clamped-bound"},
           {Ranges::infinite, "infinite"}}};
}
constexpr NameTable<NearField, 2> names(NearField) {
  return {{{NearField::disc, "disc"}, {NearField::point, "point"}}};
}
constexpr NameTable<Filter, 2> names(Filter) { return {{{Filter::bilateral, "bilateral"}, {Filter::none, "none"}}}; }
constexpr NameTable<Isa, 4> names(Isa) {
  return {{{Isa::automatic, "auto"}, {Isa::avx512, "avx512"}, {Isa::avx2, "avx2"}, {Isa::baseline, "baseline"}}};
}

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
