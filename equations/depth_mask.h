// SPDX-License-Identifier: Apache-2.0
// 2.5D culling [Harada 2012], which [TH16] sect. 4.4 uses: a tile's depth range in 32 slices, one bit each. A light
// whose slices hold no surface of the tile is skipped, even where the tile's depth range is long and mostly empty.
#ifndef LUCIOLE_DEPTH_MASK_H
#define LUCIOLE_DEPTH_MASK_H
#include "equations/tile_test.h"

struct DepthSlices {
  real depth_low;         // of the tile   [m]
  real slices_per_metre;  // [1/m]
};

// depth_low <= depth_high: the tile's depth range  [m]
LUCIOLE_FN DepthSlices depth_slices(real depth_low, real depth_high) {
  DepthSlices slices;
  slices.depth_low = depth_low;
  slices.slices_per_metre = 32.0f / max(depth_high - depth_low, real(1e-20f));
  return slices;
}

// The slice of a depth, 0 ... 31. Rounding keeps order, so a depth within a range is never outside the range's slices.
LUCIOLE_FN uint_ depth_slice(DepthSlices slices, real depth) {
  const real slice = (depth - slices.depth_low) * slices.slices_per_metre;
  return uint_from_real(clamp(slice, real(0.0f), real(31.0f)));
}

// Bit of a surface. The tile's mask is the union over its pixels.
LUCIOLE_FN uint_ surface_depth_mask(DepthSlices slices, real depth) {
  return shift_left(uint_(1u), depth_slice(slices, depth));
}

// Bits of a depth range; never none, as ends outside the tile's range count as its first or last slice.
//   depth_low <= depth_high  [m]
LUCIOLE_FN uint_ range_depth_mask(DepthSlices slices, real depth_low, real depth_high) {
  const uint_ from_low = shift_left(uint_(0xffffffffu), depth_slice(slices, depth_low));
  const uint_ to_high = shift_right(uint_(0xffffffffu), uint_(31u) - depth_slice(slices, depth_high));
  return from_low & to_high;
}

// Does a light's bound cover a slice that holds a surface?
//   tile_mask  union of surface_depth_mask over the tile's pixels
LUCIOLE_FN mask ellipsoid_meets_depths(TileTestEllipsoid t, DepthSlices slices, uint_ tile_mask) {
  const real extent = sqrt(t.szz);
  return (range_depth_mask(slices, t.centre.z - extent, t.centre.z + extent) & tile_mask) != uint_(0u);
}
LUCIOLE_FN mask sphere_meets_depths(TileTestSphere t, DepthSlices slices, uint_ tile_mask) {
  const real extent = sqrt(t.radius_sq) * 1.0001f;
  return (range_depth_mask(slices, t.centre.z - extent, t.centre.z + extent) & tile_mask) != uint_(0u);
}

#endif
