// SPDX-License-Identifier: Apache-2.0
// For tests: rays through a scene, one per invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/device_scene/scene.glsl"
#include "real_time/device_scene/probe_records.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Queries { RayQuery value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Answers { RayAnswer value[]; };
layout(push_constant, scalar) uniform Push { ProbePush push; };

SceneRecord scene() { return SceneAt(push.scene).value; }

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= push.count) return;
  const RayQuery query = Queries(push.queries).value[i];
  const Ray ray = Ray(vector(query.origin), vector(query.direction), query.nearest, query.farthest);
  const Hit hit = trace_scene(ray, push.any != 0u);
  Answers(push.answers).value[i] =
      RayAnswer(hit.mesh, hit.triangle, hit.uv.x, hit.uv.y, hit.distance, hit.complete ? 1u : 0u, hit.turns);
}
