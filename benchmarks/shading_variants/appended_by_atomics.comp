// SPDX-License-Identifier: Apache-2.0
// Lists in the order in which invocations come: a counter in shared memory instead of ballots, and fewer barriers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "benchmarks/shading_variants/variant.glsl"

shared uint length_of_half[2];

void list_by_atomics(SubsetRange subset, uint first, uint end, TileHalves halves, SidePlanes sides,
                     inout uint counts[2]) {
  if (thread() < 2u) length_of_half[thread()] = 0u;
  barrier();
  for (uint light = first + thread(); light < end; light += kThreads) {
    const HalfMasks hit = touches(subset.begin + light, halves.tile, sides);
    if (hit.near_half) listed[0][atomicAdd(length_of_half[0], 1u)] = light;
    if (hit.far_half) listed[1][atomicAdd(length_of_half[1], 1u)] = light;
  }
  barrier();
  counts = uint[2](length_of_half[0], length_of_half[1]);
}

#define LIST_LIGHTS list_by_atomics
#include "real_time/shading/tile_loop.glsl"

void main() {
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  shade_tile(gl_WorkGroupID, gl_NumWorkGroups, pixel, halve(pixel));
}
