// SPDX-License-Identifier: Apache-2.0
// Pass geometry_buffer, rasterised: from the triangle that each pixel shows to the surface there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/device_scene/scene.glsl"
#include "real_time/geometry_buffer/shown_triangle.glsl"
#include "real_time/geometry_buffer/visibility_records.h"
#include "real_time/geometry_buffer/write_pixel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Visibility { uvec2 value[]; };
layout(push_constant, scalar) uniform Push { ResolvePush push; };

SceneRecord scene() { return SceneAt(push.geometry.scene).value; }
GeometryPush frame() { return push.geometry; }

void main() {
  const GeometryPush to = push.geometry;
  const uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= to.width || at.y >= to.height) return;
  const uint index = at.y * to.width + at.x;
  const Ray ray = camera_ray(to.eye, to.top_left, to.across, to.down, at);
  const uvec2 shown = Visibility(push.visibility).value[index];
  Hit hit;
  hit.mesh = kNothing;
  if (shown.x != kNothing) hit = shown_point(shown.x, shown.y, ray);
  write_pixel(index, ray, hit);
}
