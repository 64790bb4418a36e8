// SPDX-License-Identifier: Apache-2.0
// The names of the settings' values.
#pragma once
#include "base/name_table.h"
#include "real_time/settings.h"

namespace luciole {

constexpr NameTable<BoundingVolume, 4> names(BoundingVolume) {
  return {{{BoundingVolume::sphere_at_light, "sphere-at-light"},
           {BoundingVolume::sphere, "sphere"},
           {BoundingVolume::spheroid, "spheroid"},
           {BoundingVolume::tight, "tight"}}};
}
constexpr NameTable<TileTest, 3> names(TileTest) {
  return {{{TileTest::paper, "paper"}, {TileTest::exact, "exact"}, {TileTest::tight, "tight"}}};
}
constexpr NameTable<Culling, 4> names(Culling) {
  return {{{Culling::tiled, "tiled"},
           {Culling::clustered, "clustered"},
           {Culling::splatting, "splatting"},
           {Culling::none, "none"}}};
}
constexpr NameTable<Ranges, 4> names(Ranges) {
  return {{{Ranges::stochastic, "stochastic"},
           {Ranges::clamped, "clamped"},
           {Ranges::clamped_bound, "clamped-bound"},
           {Ranges::infinite, "infinite"}}};
}
constexpr NameTable<Lobes, 3> names(Lobes) {
  return {{{Lobes::all, "all"}, {Lobes::diffuse, "diffuse"}, {Lobes::glossy, "glossy"}}};
}
constexpr NameTable<NearField, 2> names(NearField) {
  return {{{NearField::disc, "disc"}, {NearField::point, "point"}}};
}
constexpr NameTable<Engine, 3> names(Engine) {
  return {{{Engine::cpu, "cpu"}, {Engine::vulkan, "vulkan"}, {Engine::automatic, "auto"}}};
}
constexpr NameTable<Front, 4> names(Front) {
  return {{{Front::automatic, "auto"}, {Front::cpu, "cpu"}, {Front::raster, "raster"}, {Front::rays, "rays"}}};
}
constexpr NameTable<Filter, 2> names(Filter) { return {{{Filter::bilateral, "bilateral"}, {Filter::none, "none"}}}; }

}  // namespace luciole
