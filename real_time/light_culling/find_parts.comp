// SPDX-License-Identifier: Apache-2.0
// Which parts of a tile show a surface, and for splatting where each pixel is: a tile per workgroup, as tile_parts.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "real_time/light_culling/list_records.h"

layout(local_size_x = 256) in;
layout(constant_id = 0) const uint kClusters = 1u;  // 0: cells of 4x4 pixels
layout(push_constant, scalar) uniform Push { PartPush push; };
#include "real_time/light_culling/cluster_slices.glsl"
#include "real_time/shading/tile_pixel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Occupied { uint value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Cells { SplatCell value[]; };

shared uint occupied;
shared uint nearest[16];  // bits of a cell's least depth

void main() {
  const uint thread = gl_LocalInvocationIndex, cell = thread / 16u, lane = thread % 16u;
  const uint tile = (gl_WorkGroupID.z * gl_NumWorkGroups.y + gl_WorkGroupID.y) * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (thread == 0u) occupied = 0u;
  if (thread < 16u) nearest[thread] = 0xffffffffu;
  barrier();
  const TilePixel pixel = read_pixel(thread, gl_WorkGroupID);
  if (pixel.is_surface) {
    atomicOr(occupied, 1u << (kClusters != 0u ? cluster_slice_of(read_slices(), pixel.record.depth) : cell));
    atomicMin(nearest[cell], floatBitsToUint(pixel.record.depth));
  }
  barrier();
  if (thread == 0u) Occupied(push.occupied).value[tile] = occupied;
  if (kClusters != 0u) return;
  const vec3 view = view_of(pixel, push.eye, push.right, push.up);
  const uint at = tile * 16u + cell;
  Cells cells = Cells(push.cells);
  cells.value[at].x[lane] = pixel.is_surface ? view.x / view.z : 0.0;
  cells.value[at].y[lane] = pixel.is_surface ? view.y / view.z : 0.0;
  cells.value[at].depth[lane] = pixel.is_surface ? view.z : -1.0;
  if (lane == 0u) cells.value[at].nearest = uintBitsToFloat(nearest[cell]);
}
