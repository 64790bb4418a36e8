// SPDX-License-Identifier: Apache-2.0
// Which lights of a tree reach into a box: sixteen at a time, compiled for each instruction set.
#pragma once
#include <cstdint>

namespace luciole {

inline constexpr std::uint32_t kBlockSpheres = 16;

// Sixteen lights; reach_sq < 0: none.
struct alignas(64) SphereBlock {
  float x[kBlockSpheres], y[kBlockSpheres], z[kBlockSpheres];  // centres [m]
  float reach_sq[kBlockSpheres];                               // squared radii [m^2]
};

// Sixteen nodes: the box of their spheres' centres, and the largest radius. What touches a sphere is no further from
// the box than that. Spheres round spheres, as [TH16] has them, are looser: of lights along a curve they visit twice as
// many nodes.
struct alignas(64) NodeBlock {
  float low[3][kBlockSpheres], high[3][kBlockSpheres];  // [m]
  float reach_sq[kBlockSpheres];
};

// A tree without pointers: node k of block b of level l holds block 16 b + k of level l - 1. Level 0 are the lights.
struct SphereTree {
  static constexpr std::uint32_t kMostLevels = 8;
  const SphereBlock* spheres = nullptr;
  const NodeBlock* nodes = nullptr;
  const std::uint32_t* light = nullptr;         // by sphere
  std::uint32_t levels = 0;                     // 0: no light
  std::uint32_t first_block[kMostLevels] = {};  // of each level above 0, among the nodes
};

// The part of the lights that a walk looks for, and where.
struct WalkBounds {
  float low[3], high[3];                 // box [m]
  std::uint32_t first_block, end_block;  // of level 0
};

// Where a walk through the tree stands: blocks to be looked at, level << 28 | index.
struct TreeWalk {
  static constexpr std::uint32_t kLevelShift = 28;
  std::uint32_t pending[SphereTree::kMostLevels * kBlockSpheres];
  std::uint32_t depth = 0;

  explicit TreeWalk(const SphereTree& tree) {
    if (tree.levels > 0) pending[depth++] = (tree.levels - 1) << kLevelShift;
  }
  bool done() const { return depth == 0; }
};

#define LUCIOLE_DECLARE_OVERLAP_KERNEL(isa)                                                                          \
  namespace isa {                                                                                                    \
  /* Goes on with a walk; writes the lights whose spheres touch the box, in their order, until `capacity` may not */ \
  /* suffice for one more block or the walk is done. Returns how many; capacity >= 16. */                            \
  std::uint32_t overlapping_lights(const SphereTree& tree, const WalkBounds& bounds, TreeWalk& walk,                 \
                                   std::uint32_t* out, std::uint32_t capacity);                                      \
  }
LUCIOLE_DECLARE_OVERLAP_KERNEL(avx512)
LUCIOLE_DECLARE_OVERLAP_KERNEL(avx2)
LUCIOLE_DECLARE_OVERLAP_KERNEL(baseline)
#undef LUCIOLE_DECLARE_OVERLAP_KERNEL

}  // namespace luciole
