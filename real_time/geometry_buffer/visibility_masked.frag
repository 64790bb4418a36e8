// SPDX-License-Identifier: Apache-2.0
// A pixel shows a triangle of a mesh that has holes, if its ray would end there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/device_scene/scene.glsl"
#include "real_time/geometry_buffer/camera_ray.glsl"
#include "real_time/geometry_buffer/shown_triangle.glsl"
#include "real_time/geometry_buffer/visibility_records.h"

layout(push_constant, scalar) uniform Push { VisibilityPush push; };
layout(location = 0) flat in uvec2 shown;
layout(location = 0) out uvec2 words;

SceneRecord scene() { return SceneAt(push.scene).value; }

void main() {
  const Ray ray = camera_ray(push.projection.eye, push.top_left, push.across, push.down, uvec2(gl_FragCoord.xy));
  const Hit hit = shown_point(shown.x, shown.y, ray);
  if (!stops_ray(hit.mesh, hit.triangle, hit.uv)) discard;
  words = shown;
}
