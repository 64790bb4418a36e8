// SPDX-License-Identifier: Apache-2.0
#include "offline/light_tree/overlap_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
namespace {

// Bit k: sphere k of the block holds the point.
LUCIOLE_FN std::uint32_t holding_spheres(const SphereBlock& block, real3 point) {
  std::uint32_t bits = 0;
  for (int lane = 0; lane < static_cast<int>(kBlockSpheres); lane += kLanes) {
    const real3 centre(load(block.x + lane), load(block.y + lane), load(block.z + lane));
    const real3 apart = point - centre;
    bits |= lane_bits(dot(apart, apart) < load(block.reach_sq + lane)) << lane;
  }
  return bits;
}

}  // namespace

std::uint32_t overlapping_lights(const SphereTree& tree, const float point[3], TreeWalk& walk, std::uint32_t* out,
                                 std::uint32_t capacity) {
  const real3 at(point[0], point[1], point[2]);
  std::uint32_t count = 0, depth = walk.depth;
  while (depth > 0 && count + kBlockSpheres <= capacity) {
    const std::uint32_t entry = walk.pending[--depth];
    const std::uint32_t level = entry >> TreeWalk::kLevelShift;
    const std::uint32_t index = entry & ((1u << TreeWalk::kLevelShift) - 1);
    std::uint32_t bits = holding_spheres(tree.blocks[tree.first_block[level] + index], at);
    if (level == 0) {
      for (; bits != 0; bits &= bits - 1) {
        out[count++] = tree.light[index * kBlockSpheres + static_cast<std::uint32_t>(__builtin_ctz(bits))];
      }
    } else {
      // The last first, so that lights come out in their order.
      while (bits != 0) {
        const std::uint32_t highest = 31u - static_cast<std::uint32_t>(__builtin_clz(bits));
        bits ^= 1u << highest;
        walk.pending[depth++] = ((level - 1) << TreeWalk::kLevelShift) | (index * kBlockSpheres + highest);
      }
    }
  }
  walk.depth = depth;
  return count;
}

}  // namespace luciole::LUCIOLE_ISA
