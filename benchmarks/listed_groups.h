// SPDX-License-Identifier: Apache-2.0
// Work for the shading kernels as the frame gives it to them: groups of pixels with their lists of lights.
#pragma once
#include <vector>

#include "benchmarks/stage.h"
#include "real_time/light_range/reaching_lights.h"
#include "real_time/shading/shade_kernel.h"

namespace luciole {

template <class Emitter>
struct ListedGroups {
  AlignedVector<Emitter> emitters;
  AlignedVector<PixelGroup> groups;
  std::vector<std::vector<std::uint32_t>> lists;  // one per group, into emitters

  std::uint64_t pairs() const;  // light x pixel
  LightList<Emitter> list(std::size_t group) const;
};

// The groups of all tiles of one block of 16n x 16n pixels, and what the tile test and the group test leave to each.
ListedGroups<DiffuseEmitter> diffuse_groups(const PreparedStage& stage, std::uint32_t bx, std::uint32_t by);
ListedGroups<GlossyEmitter> glossy_groups(const PreparedStage& stage, std::uint32_t bx, std::uint32_t by);

// Accepted light x pixel pairs.
template <class Emitter>
std::uint64_t accepted_pairs(const ListedGroups<Emitter>& work);
// Light x group pairs where some pixel accepts.
template <class Emitter>
std::uint64_t groups_that_accept(const ListedGroups<Emitter>& work);

// As `real`, but each list holds only lights whose whole group takes part, and all of them are accepted.
template <class Emitter>
ListedGroups<Emitter> all_accepted(const ListedGroups<Emitter>& real);
// As `real`, but nothing is accepted.
template <class Emitter>
ListedGroups<Emitter> all_rejected(const ListedGroups<Emitter>& real);

}  // namespace luciole
