// SPDX-License-Identifier: Apache-2.0
// The nearest and the farthest surface of a frame, between which clusters have their slices: a tile per workgroup. Bits
// of positive floats are in their order, so whole numbers do, and the order of invocations does not show.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "real_time/light_culling/list_records.h"

layout(local_size_x = 256) in;
layout(push_constant, scalar) uniform Push { PartPush push; };
#include "real_time/light_culling/cluster_slices.glsl"
#include "real_time/shading/tile_pixel.glsl"

shared uint depths[2];

void main() {
  const uint thread = gl_LocalInvocationIndex;
  if (thread < 2u) depths[thread] = 0u;
  barrier();
  const TilePixel pixel = read_pixel(thread, gl_WorkGroupID);
  const uint bits = floatBitsToUint(pixel.record.depth);
  if (pixel.is_surface) {
    atomicMax(depths[0], ~bits);
    atomicMax(depths[1], bits);
  }
  barrier();
  if (thread < 2u && depths[thread] != 0u) atomicMax(Depths(push.depths).value[thread], depths[thread]);
}
