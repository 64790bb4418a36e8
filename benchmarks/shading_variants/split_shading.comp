// SPDX-License-Identifier: Apache-2.0
// The second of two kernels: no tile is measured and no light asked, so that it holds fewer registers and waits for none.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "benchmarks/shading_variants/variant.glsl"
#include "benchmarks/shading_variants/lists_in_memory.glsl"

void main() {
  const ListHeader header = header_at(gl_WorkGroupID, gl_NumWorkGroups).value;
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  const SubsetRange subset = subset_of(gl_WorkGroupID.z);
  TileHalves halves;
  halves.pixels = header.pixels;
  halves.half_of_pixel = pixel.view.z > header.middle ? 1u : 0u;
  ListAt list = list_at(gl_WorkGroupID, gl_NumWorkGroups, halves.half_of_pixel);
  const uint length = pixel.is_surface ? header.listed[halves.half_of_pixel] : 0u;
  ShadedPixel shaded = start_pixel(pixel.record);
  for (uint i = 0u; i < length; ++i) add_light(shaded, subset.begin + list.value[i]);
  write_counts(gl_WorkGroupID, gl_NumWorkGroups, halves, header.listed, shaded.accepted, header.asked);
  write_sums(pixel, shaded, header.listed[halves.half_of_pixel]);
}
