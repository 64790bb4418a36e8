// SPDX-License-Identifier: Apache-2.0
// Passes culling and shading in one, [TH17] sect. 6: a workgroup is a 16x16 tile of one sub-region of the de-interleaved
// screen. It finds the tile's two depth halves, asks its subset's lights in batches, keeps those that touch a half in a
// list in shared memory, and adds each list to the half's pixels. benchmarks/shading_variants has what else was tried.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#if defined(LUCIOLE_DIRECT_SHADOWS)
#include "real_time/device_scene/scene.glsl"
#endif
#include "real_time/shading/shading_records.h"

layout(constant_id = 0) const uint kKind = 0u;       // 0 diffuse, 1 glossy, 2 many
layout(constant_id = 1) const uint kTileTest = 2u;   // TileTest: 0 paper, 1 exact, 2 tight
layout(constant_id = 2) const uint kCulled = 1u;     // 0: every light at every pixel
layout(constant_id = 3) const uint kDivideByP = 1u;  // 0: clamped and infinite ranges
layout(push_constant, scalar) uniform Push {
  ShadingPush push;
#if defined(LUCIOLE_DIRECT_SHADOWS)
  uint64_t shadows;
#endif
};

#include "real_time/shading/tile_lists.glsl"
#include "real_time/shading/pixel_sums.glsl"

layout(local_size_x = kThreads) in;

void main() {
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  const TileHalves halves = halve(pixel);
  uint lights_of_half[2] = uint[2](0u, 0u);
  ShadedPixel shaded = start_pixel(pixel.record);
  if (push.first_light > 0u && pixel.is_surface) take_earlier_sums(shaded, pixel.index);
  const SubsetRange subset = subset_of(gl_WorkGroupID.z);
  const uint end = min(subset.count, push.first_light + push.light_count);
  const SidePlanes sides = side_planes(halves.tile);
  const bool any_surface = halves.pixels[0] + halves.pixels[1] > 0u;
  for (uint batch = push.first_light; any_surface && batch < end; batch += kBatch) {
    uint counts[2] = uint[2](0u, 0u);
    list_lights(subset, batch, min(end, batch + kBatch), halves, sides, counts);
    const uint length = pixel.is_surface ? counts[halves.half_of_pixel] : 0u;
    for (uint i = 0u; i < length; ++i) add_light(shaded, subset.begin + listed[halves.half_of_pixel][i]);
    lights_of_half[0] += halves.pixels[0] > 0u ? counts[0] : 0u;
    lights_of_half[1] += halves.pixels[1] > 0u ? counts[1] : 0u;
    barrier();  // the next batch writes the lists anew
  }
  write_counts(gl_WorkGroupID, gl_NumWorkGroups, halves, lights_of_half, shaded.accepted,
               any_surface && kCulled != 0u ? end : 0u);
  write_sums(pixel, shaded, lights_of_half[halves.half_of_pixel]);
}
