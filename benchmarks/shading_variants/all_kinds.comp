// SPDX-License-Identifier: Apache-2.0
// All kinds of light in one dispatch: a tile's pixels are read and measured once, not three times.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "benchmarks/shading_variants/variant_records.h"

layout(constant_id = 1) const uint kTileTest = 2u;
layout(constant_id = 2) const uint kCulled = 1u;
layout(constant_id = 3) const uint kDivideByP = 1u;
layout(push_constant, scalar) uniform Push {
  ShadingPush of_any_kind;
  uint64_t of_kinds;
};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer OfKinds { ShadingPush value[3]; };

uint kKind;  // constants of the other variants, by the same names
ShadingPush push;

#include "real_time/shading/tile_lists.glsl"
#include "real_time/shading/pixel_sums.glsl"
#include "real_time/shading/tile_loop.glsl"

layout(local_size_x = kThreads) in;

void shade_kind(uint kind, TilePixel pixel, TileHalves halves) {
  kKind = kind;
  push = OfKinds(of_kinds).value[kind];
  if (push.light_count > 0u) shade_tile(gl_WorkGroupID, gl_NumWorkGroups, pixel, halves);
}

void main() {
  push = of_any_kind;
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  const TileHalves halves = halve(pixel);
  shade_kind(0u, pixel, halves);
  shade_kind(1u, pixel, halves);
  shade_kind(2u, pixel, halves);
}
