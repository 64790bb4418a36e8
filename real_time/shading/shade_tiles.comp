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
#if defined(LUCIOLE_LIGHTS_BY_SUBGROUP)
#include "real_time/shading/lights_by_subgroup.glsl"
#define SHADE_LIGHTS shade_by_subgroup
#endif
#include "real_time/shading/tile_loop.glsl"

layout(local_size_x = kThreads) in;

void main() {
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  shade_tile(gl_WorkGroupID, gl_NumWorkGroups, pixel, halve(pixel));
}
