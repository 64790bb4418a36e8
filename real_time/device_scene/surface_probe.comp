// SPDX-License-Identifier: Apache-2.0
// For tests: surfaces of a scene, one per invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "base/vectors.glsl"
#include "real_time/device_scene/scene.glsl"
#include "real_time/device_scene/probe_records.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Queries { SurfaceQuery value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Answers { SurfaceAnswer value[]; };
layout(push_constant, scalar) uniform Push { ProbePush push; };

SceneRecord scene() { return SceneAt(push.scene).value; }

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  const SurfaceQuery q = Queries(push.queries).value[i];
  const vec2 uv = vec2(q.u, q.v);
  const Surface s = surface_at(q.mesh, q.triangle, uv, vector(q.direction), q.cone_width);
  SurfaceAnswer a;
  a.position = numbers(s.position);
  a.geometric_normal = numbers(s.geometric_normal);
  a.shading_normal = numbers(s.shading_normal);
  a.diffuse_albedo = numbers(s.brdf.diffuse_albedo);
  a.f0 = numbers(s.brdf.f0);
  a.f90 = s.brdf.f90;
  a.ggx_alpha = s.brdf.ggx_alpha;
  a.emission = numbers(s.emission);
  a.stops_ray = stops_ray(q.mesh, q.triangle, uv) ? 1u : 0u;
  Answers(push.answers).value[i] = a;
}
