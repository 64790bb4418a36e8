// SPDX-License-Identifier: Apache-2.0
#include "offline/light_tree/overlap_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
namespace {

// Bit k: sphere k of the block touches the box.
LUCIOLE_FN std::uint32_t touching_spheres(const SphereBlock& block, real3 low, real3 high) {
  std::uint32_t bits = 0;
  for (int lane = 0; lane < static_cast<int>(kBlockSpheres); lane += kLanes) {
    const real3 centre(load(block.x + lane), load(block.y + lane), load(block.z + lane));
    const real3 apart = max(max(low - centre, centre - high), real3(0.0f, 0.0f, 0.0f));
    bits |= lane_bits(dot(apart, apart) < load(block.reach_sq + lane)) << lane;
  }
  return bits;
}

// Bit k: some sphere of node k may touch the box.
LUCIOLE_FN std::uint32_t touching_nodes(const NodeBlock& block, real3 low, real3 high) {
  std::uint32_t bits = 0;
  for (int lane = 0; lane < static_cast<int>(kBlockSpheres); lane += kLanes) {
    const real3 node_low(load(block.low[0] + lane), load(block.low[1] + lane), load(block.low[2] + lane));
    const real3 node_high(load(block.high[0] + lane), load(block.high[1] + lane), load(block.high[2] + lane));
    const real3 apart = max(max(low - node_high, node_low - high), real3(0.0f, 0.0f, 0.0f));
    bits |= lane_bits(dot(apart, apart) < load(block.reach_sq + lane)) << lane;
  }
  return bits;
}

// Bit k: child k of a block of `level` covers level 0 blocks of the range [first, end).
LUCIOLE_FN std::uint32_t children_in_range(std::uint32_t level, std::uint32_t index, std::uint32_t first,
                                           std::uint32_t end) {
  const std::uint32_t shift = 4 * (level - 1);  // log2 of level 0 blocks per child
  const std::uint32_t own = index * kBlockSpheres;
  const std::uint32_t first_child = first >> shift, end_child = (end + (1u << shift) - 1) >> shift;
  const std::uint32_t skipped = first_child > own ? first_child - own : 0;
  const std::uint32_t kept = end_child > own ? end_child - own : 0;
  const std::uint32_t below = kept >= kBlockSpheres ? 0xffffu : (1u << kept) - 1;
  return skipped >= kBlockSpheres ? 0 : below & (0xffffu << skipped);
}

}  // namespace

std::uint32_t overlapping_lights(const SphereTree& tree, const WalkBounds& bounds, TreeWalk& walk, std::uint32_t* out,
                                 std::uint32_t capacity) {
  const real3 low(bounds.low[0], bounds.low[1], bounds.low[2]), high(bounds.high[0], bounds.high[1], bounds.high[2]);
  std::uint32_t count = 0, depth = walk.depth;
  while (depth > 0 && count + kBlockSpheres <= capacity) {
    const std::uint32_t entry = walk.pending[--depth];
    const std::uint32_t level = entry >> TreeWalk::kLevelShift;
    const std::uint32_t index = entry & ((1u << TreeWalk::kLevelShift) - 1);
    if (level == 0) {
      std::uint32_t bits = touching_spheres(tree.spheres[index], low, high);
      for (; bits != 0; bits &= bits - 1) {
        out[count++] = tree.light[index * kBlockSpheres + static_cast<std::uint32_t>(__builtin_ctz(bits))];
      }
      continue;
    }
    std::uint32_t bits = touching_nodes(tree.nodes[tree.first_block[level] + index], low, high) &
                         children_in_range(level, index, bounds.first_block, bounds.end_block);
    // The last first, so that lights come out in their order.
    while (bits != 0) {
      const std::uint32_t last = 31u - static_cast<std::uint32_t>(__builtin_clz(bits));
      bits ^= 1u << last;
      walk.pending[depth++] = ((level - 1) << TreeWalk::kLevelShift) | (index * kBlockSpheres + last);
    }
  }
  walk.depth = depth;
  return count;
}

}  // namespace luciole::LUCIOLE_ISA
