// SPDX-License-Identifier: Apache-2.0
// Door: lights with this frame's random number and the volume that it lets them reach. One entry per lobe, ordered by
// interleaving subset: a light stands in subset key mod n^2, in the order of the pass's input.
#pragma once
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "real_time/light_range/emitters.h"

namespace luciole {

// Lights of one kind. Subset s holds lobes [begin[s], begin[s] + count[s]); begin is a multiple of 16, and the lanes
// between the subsets reach nothing.
template <class Emitter>
struct ReachingLights {
  AlignedVector<Emitter> emitters;
  AlignedVector<BoundBlock> bounds;  // block b holds lights 16 b ... 16 b + 15
  std::vector<std::uint32_t> begin, count;
};

}  // namespace luciole
