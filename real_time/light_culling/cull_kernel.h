// SPDX-License-Identifier: Apache-2.0
// Which lights reach a tile, and which of those reach a group of its pixels. One light per lane.
#pragma once
#include <cstdint>

#include "real_time/light_range/reaching_lights.h"
#include "real_time/settings.h"
#include "real_time/shading/pixel_group.h"

namespace luciole {

// The frustum pieces of a tile in view space: slopes common to both depth halves, and each half's depths [m]. An empty
// half has low > high.
struct TileFrustum {
  float x_low, x_high, y_low, y_high;
  float near_low, near_high, far_low, far_high;
};

// Lights that the tile test left for one depth half: indices into the subset, ascending, and the rows of their bounds
// that the group test reads, side by side. The memory holds a whole subset and 16 more: a list is never too short.
struct TouchingLights {
  enum Row : int { kM00, kM01, kM02, kM11, kM12, kM22, kX, kY, kZ, kNx, kNy, kNz, kOffset, kRows };
  std::uint32_t* index;
  float* row[kRows];
  std::uint32_t count;
};

// Declares, in the namespace of one instruction set:
//   cull_tile   blocks of one subset (the last may be partly used) against a tile; fills both halves' lists
//   cull_group  a half's list against the box round 16 pixels; returns the length of `list` (indices into the subset)
#define LUCIOLE_DECLARE_CULL_KERNELS(isa)                                                                        \
  namespace luciole::isa {                                                                                       \
  void cull_tile(const BoundBlock* blocks, std::uint32_t block_count, const TileFrustum& frustum, TileTest test, \
                 TouchingLights& near_half, TouchingLights& far_half);                                           \
  std::uint32_t cull_group(const TouchingLights& lights, const PixelGroup& group, std::uint32_t* list);          \
  }
}  // namespace luciole
LUCIOLE_DECLARE_CULL_KERNELS(avx512)
LUCIOLE_DECLARE_CULL_KERNELS(avx2)
LUCIOLE_DECLARE_CULL_KERNELS(baseline)
#undef LUCIOLE_DECLARE_CULL_KERNELS
