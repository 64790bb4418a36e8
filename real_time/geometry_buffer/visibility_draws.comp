// SPDX-License-Identifier: Apache-2.0
// Which meshes are drawn: those whose bounds reach into the view. A mesh per invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "base/vectors.glsl"
#include "real_time/device_scene/scene_records.h"
#include "real_time/geometry_buffer/visibility_records.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer BoundsAt { MeshBounds value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Draws { DrawRecord value[]; };
layout(push_constant, scalar) uniform Push { DrawsPush push; };

// Whether all of a box, relative to the eye, lies where `plane . p` is negative. A dozen roundings in favour of the box.
bool is_behind(vec3 plane, vec3 low, vec3 high) {
  const float most = dot(max(plane * low, plane * high), vec3(1.0));
  return most < -1.0 / 1048576.0 * dot(abs(plane), max(abs(low), abs(high)));
}

bool is_seen(MeshBounds bounds) {
  const Projection to = push.projection;
  const vec3 low = vector(bounds.low) - vector(to.eye), high = vector(bounds.high) - vector(to.eye);
  const vec3 x = vector(to.x), y = vector(to.y), w = vector(to.w);
  return bounds.triangles > 0u && !is_behind(w, low, high) && !is_behind(w + x, low, high) &&
         !is_behind(w - x, low, high) && !is_behind(w + y, low, high) && !is_behind(w - y, low, high);
}

void main() {
  const uint mesh = gl_GlobalInvocationID.x;
  if (mesh >= push.meshes) return;
  const MeshBounds bounds = BoundsAt(push.bounds).value[mesh];
  const uint seen = is_seen(bounds) ? 1u : 0u;
  const bool has_holes = bounds.has_holes != 0u;
  Draws(push.draws).value[mesh] = DrawRecord(3u * bounds.triangles, has_holes ? 0u : seen, 0u, mesh);
  Draws(push.draws).value[push.meshes + mesh] = DrawRecord(3u * bounds.triangles, has_holes ? seen : 0u, 0u, mesh);
}
