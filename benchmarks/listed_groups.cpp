// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/listed_groups.h"

#include <bit>

#include "base/isa.h"
#include "real_time/light_range/light_range.h"
#include "real_time/shading/tile_worker.h"

namespace luciole {
namespace {

RangeParameters ranges(const PreparedStage& stage) {
  return range_parameters(stage.settings, stage.camera, {stage.settings.seed, 0}, -1.0f);
}

template <class Emitter>
ListedGroups<Emitter> list(const PreparedStage& stage, const ReachingLights<Emitter>& lights, std::uint32_t bx,
                           std::uint32_t by) {
  const std::uint32_t n = stage.settings.interleave;
  ListedGroups<Emitter> work;
  work.emitters = lights.emitters;
  ScreenTile tile;
  ListMemory halves[2];
  std::vector<std::uint32_t> kept;
  for (std::uint32_t s = 0; s < n * n; ++s) {
    read_tile(stage.geometry, {n, bx, by, s % n, s / n}, tile);
    const std::uint32_t count = lights.count[s], begin = lights.begin[s];
    TouchingLights& near_half = halves[0].reserve(count);
    TouchingLights& far_half = halves[1].reserve(count);
    LUCIOLE_FOR_ISA(stage.settings.isa, cull_tile(lights.bounds.data() + begin / 16, (count + 15) / 16,
                                                  frustum_of(tile), stage.settings.tile_test, near_half, far_half));
    kept.resize(count + 16);
    for (std::uint32_t g = 0; g < tile.group_count; ++g) {
      const PixelGroup& group = tile.groups[g];
      const std::uint32_t length =
          LUCIOLE_FOR_ISA(stage.settings.isa, cull_group(halves[group.part].lists(), group, kept.data()));
      work.groups.push_back(group);
      work.lists.emplace_back(kept.begin(), kept.begin() + length);
      for (std::uint32_t& index : work.lists.back()) index += begin;
    }
  }
  return work;
}

template <class Emitter>
std::vector<std::uint16_t> lanes_of(const ListedGroups<Emitter>& work, std::size_t g) {
  std::vector<std::uint16_t> lanes(work.lists[g].size());
  const Isa isa = *choose_isa(Isa::automatic);
  LUCIOLE_FOR_ISA(isa, accepted_lanes(work.groups[g], work.list(g), lanes.data()));
  return lanes;
}

template <class Emitter>
bool faces_all(const PixelGroup& group, const Emitter& light) {
  for (int lane = 0; lane < kGroupPixels; ++lane) {
    float cos = 0;
    for (int c = 0; c < 3; ++c) {
      cos += group.geometric_normal[c][lane] * (light.position[c] - group.position[c][lane]);
    }
    if (cos <= 0) return false;
  }
  return true;
}

}  // namespace

template <class Emitter>
std::uint64_t ListedGroups<Emitter>::pairs() const {
  std::uint64_t sum = 0;
  for (const auto& one : lists) sum += one.size() * kGroupPixels;
  return sum;
}

template <class Emitter>
LightList<Emitter> ListedGroups<Emitter>::list(std::size_t group) const {
  return {emitters.data(), lists[group].data(), static_cast<std::uint32_t>(lists[group].size()), nullptr};
}

ListedGroups<DiffuseEmitter> diffuse_groups(const PreparedStage& stage, std::uint32_t bx, std::uint32_t by) {
  const Settings& s = stage.settings;
  return list(stage, reach_diffuse_lobes(stage.lights, ranges(stage), s.interleave, s.isa), bx, by);
}
ListedGroups<GlossyEmitter> glossy_groups(const PreparedStage& stage, std::uint32_t bx, std::uint32_t by) {
  const Settings& s = stage.settings;
  return list(stage, reach_glossy_lobes(stage.lights, ranges(stage), s.interleave, s.isa), bx, by);
}

template <class Emitter>
std::uint64_t accepted_pairs(const ListedGroups<Emitter>& work) {
  std::uint64_t sum = 0;
  for (std::size_t g = 0; g < work.groups.size(); ++g)
    for (std::uint16_t lanes : lanes_of(work, g)) sum += static_cast<std::uint64_t>(std::popcount(lanes));
  return sum;
}

template <class Emitter>
std::uint64_t groups_that_accept(const ListedGroups<Emitter>& work) {
  std::uint64_t sum = 0;
  for (std::size_t g = 0; g < work.groups.size(); ++g)
    for (std::uint16_t lanes : lanes_of(work, g)) sum += lanes != 0;
  return sum;
}

template <class Emitter>
ListedGroups<Emitter> all_accepted(const ListedGroups<Emitter>& real) {
  ListedGroups<Emitter> work = real;
  for (Emitter& light : work.emitters) light.xi = 0;
  for (std::size_t g = 0; g < work.groups.size(); ++g) {
    const std::vector<std::uint16_t> lanes = lanes_of(work, g);
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      const std::uint32_t index = work.lists[g][i];
      if (lanes[i] == 0xffff && faces_all(work.groups[g], work.emitters[index])) kept.push_back(index);
    }
    work.lists[g] = std::move(kept);
  }
  return work;
}

template <class Emitter>
ListedGroups<Emitter> all_rejected(const ListedGroups<Emitter>& real) {
  ListedGroups<Emitter> work = real;
  for (Emitter& light : work.emitters) light.xi = 1e30f;
  return work;
}

#define LUCIOLE_LISTED_GROUPS_OF(Emitter)                                    \
  template struct ListedGroups<Emitter>;                                     \
  template std::uint64_t accepted_pairs(const ListedGroups<Emitter>&);       \
  template std::uint64_t groups_that_accept(const ListedGroups<Emitter>&);   \
  template ListedGroups<Emitter> all_accepted(const ListedGroups<Emitter>&); \
  template ListedGroups<Emitter> all_rejected(const ListedGroups<Emitter>&);
LUCIOLE_LISTED_GROUPS_OF(DiffuseEmitter)
LUCIOLE_LISTED_GROUPS_OF(GlossyEmitter)

}  // namespace luciole
