// SPDX-License-Identifier: Apache-2.0
// The first of two kernels: lists to memory.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "benchmarks/shading_variants/variant.glsl"
#include "benchmarks/shading_variants/lists_in_memory.glsl"

void main() {
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  const TileHalves halves = halve(pixel);
  const bool any_surface = halves.pixels[0] + halves.pixels[1] > 0u;
  const SubsetRange subset = subset_of(gl_WorkGroupID.z);
  const SidePlanes sides = side_planes(halves.tile);
  uint lengths[2] = uint[2](0u, 0u);
  for (uint batch = 0u; any_surface && batch < subset.count; batch += kBatch) {
    uint counts[2] = uint[2](0u, 0u);
    list_lights(subset, batch, min(subset.count, batch + kBatch), halves, sides, counts);
    for (uint h = 0u; h < 2u; ++h) {
      if (halves.pixels[h] == 0u) continue;
      ListAt list = list_at(gl_WorkGroupID, gl_NumWorkGroups, h);
      for (uint i = thread(); i < counts[h]; i += kThreads) list.value[lengths[h] + i] = listed[h][i];
      lengths[h] += counts[h];
    }
    barrier();  // the next batch writes the lists anew
  }
  const float middle = tile_max(pixel.is_surface && halves.half_of_pixel == 0u ? pixel.view.z : 0.0);
  if (thread() == 0u) {
    header_at(gl_WorkGroupID, gl_NumWorkGroups).value =
        ListHeader(middle, halves.pixels, lengths, any_surface ? subset.count : 0u);
  }
}
