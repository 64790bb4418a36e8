// SPDX-License-Identifier: Apache-2.0
// 2.5D culling (equations/depth_mask.h) instead of two depth halves; with AND_HALVES beside them, a mask for each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "equations/depth_mask.h"
#include "benchmarks/shading_variants/variant.glsl"

DepthSlices slices;       // of the tile's depth range
uint mask_of_half[2];     // slices with a surface; without halves all are the nearer one's

uint tile_or(uint value) {
  const uint of_subgroup = subgroupOr(value);
  if (subgroupElect()) hits[gl_SubgroupID] = of_subgroup;
  barrier();
  uint all = 0u;
  for (uint s = 0u; s < gl_NumSubgroups; ++s) all |= hits[s];
  barrier();
  return all;
}

TileHalves slice(TilePixel pixel) {
  TileHalves h = halve(pixel);
  const bool has_near = h.pixels[0] > 0u, has_far = h.pixels[1] > 0u;
  const float low = has_near ? h.tile.near_low : h.tile.far_low, high = has_far ? h.tile.far_high : h.tile.near_high;
#if !defined(AND_HALVES)
  h.tile.near_low = low;
  h.tile.near_high = high;
  h.tile.far_low = 1.0;
  h.tile.far_high = 0.0;
  h.pixels = uint[2](h.pixels[0] + h.pixels[1], 0u);
  h.half_of_pixel = 0u;
#endif
  slices = depth_slices(low, high);
  const uint bit = pixel.is_surface ? surface_depth_mask(slices, pixel.view.z) : 0u;
  mask_of_half[0] = tile_or(h.half_of_pixel == 0u ? bit : 0u);
  mask_of_half[1] = tile_or(h.half_of_pixel == 1u ? bit : 0u);
  return h;
}

void list_by_depth(SubsetRange subset, uint first, uint end, TileHalves halves, SidePlanes sides,
                   inout uint counts[2]) {
  for (uint base = first; base < end; base += kThreads) {
    const uint light = base + thread(), entry = subset.begin + light;
    bool near_hit = false, far_hit = false;
    if (light < end) {
      const HalfMasks hit = touches(entry, halves.tile, sides);
      if (hit.near_half || hit.far_half) {
        const float depth = bound_row(entry, kCentreZ), extent = sqrt(bound_row(entry, kSzz));
        const uint depths = range_depth_mask(slices, depth - extent, depth + extent);
        near_hit = hit.near_half && (depths & mask_of_half[0]) != 0u;
        far_hit = hit.far_half && (depths & mask_of_half[1]) != 0u;
      }
    }
    append_lights(light, near_hit, far_hit, counts);
  }
}

#define LIST_LIGHTS list_by_depth
#include "real_time/shading/tile_loop.glsl"

void main() {
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  shade_tile(gl_WorkGroupID, gl_NumWorkGroups, pixel, slice(pixel));
}
