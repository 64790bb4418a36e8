// SPDX-License-Identifier: Apache-2.0
// Pass geometry_buffer: a primary ray per pixel, and the surface that it meets. The text follows pixel_block.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/device_scene/scene.glsl"
#include "real_time/geometry_buffer/write_pixel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counter { uint value; };
layout(push_constant, scalar) uniform Push { GeometryPush push; };

SceneRecord scene() { return SceneAt(push.scene).value; }
GeometryPush frame() { return push; }

void main() {
  const uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= push.width || at.y >= push.height) return;
  const Ray ray = camera_ray(push.eye, push.top_left, push.across, push.down, at);
  const Hit hit = trace_scene(ray, false);
  if (!hit.complete) atomicAdd(Counter(push.unfinished).value, 1u);
  write_pixel(at.y * push.width + at.x, ray, hit);
}
