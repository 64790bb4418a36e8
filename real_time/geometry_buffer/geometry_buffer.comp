// SPDX-License-Identifier: Apache-2.0
// Pass geometry_buffer: a primary ray per pixel, and the surface that it meets. The text follows pixel_block.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/device_scene/scene.glsl"
#include "real_time/geometry_buffer/geometry_records.h"
#include "real_time/shading/shading_records.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Pixels { PixelRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Surfaces { SurfaceRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counter { uint value; };
layout(push_constant, scalar) uniform Push { GeometryPush push; };

SceneRecord scene() { return SceneAt(push.scene).value; }
float[3] numbers(vec3 v) { return float[3](v.x, v.y, v.z); }

// Not unit: its part along the view is 1, so that distances along it are depths.
vec3 ray_direction(uvec2 at) {
  precise vec3 direction = vector(push.top_left) + vector(push.across) * float(at.x) + vector(push.down) * float(at.y);
  return direction;
}

void write_sky(uint index, vec3 direction) {
  PixelRecord pixel;
  pixel.position = pixel.normal = pixel.geometric_normal = pixel.f0 = float[3](0.0, 0.0, 0.0);
  pixel.depth = uintBitsToFloat(0x7f800000u);
  pixel.f90 = pixel.unused = 0.0;
  pixel.ggx_alpha = 1.0;
  SurfaceRecord surface;
  surface.diffuse_albedo = float[3](0.0, 0.0, 0.0);
  surface.emission = numbers(sky_radiance(normalize(direction)));
  surface.material = surface.mesh = surface.triangle = kNothing;
  surface.u = surface.v = 0.0;
  surface.unused = 0u;
  Pixels(push.pixels).value[index] = pixel;
  Surfaces(push.surfaces).value[index] = surface;
}

void write_surface(uint index, Hit hit, Surface met) {
  PixelRecord pixel;
  pixel.position = numbers(met.position);
  pixel.depth = dot(met.position - vector(push.eye), vector(push.forward));
  pixel.normal = numbers(met.shading_normal);
  pixel.f90 = met.brdf.f90;
  pixel.geometric_normal = numbers(met.geometric_normal);
  pixel.ggx_alpha = met.brdf.ggx_alpha;
  pixel.f0 = numbers(met.brdf.f0);
  pixel.unused = 0.0;
  SurfaceRecord surface;
  surface.diffuse_albedo = numbers(met.brdf.diffuse_albedo);
  surface.emission = numbers(met.emission);
  surface.material = met.material;
  surface.mesh = hit.mesh;
  surface.triangle = hit.triangle;
  surface.u = hit.uv.x;
  surface.v = hit.uv.y;
  surface.unused = 0u;
  Pixels(push.pixels).value[index] = pixel;
  Surfaces(push.surfaces).value[index] = surface;
}

void main() {
  const uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= push.width || at.y >= push.height) return;
  const uint index = at.y * push.width + at.x;
  Ray ray;
  ray.origin = vector(push.eye);
  ray.direction = ray_direction(at);
  ray.nearest = 0.0;
  ray.farthest = uintBitsToFloat(0x7f800000u);
  const Hit hit = trace_scene(ray, false);
  if (!hit.complete) atomicAdd(Counter(push.unfinished).value, 1u);
  if (hit.mesh == kNothing) {
    write_sky(index, ray.direction);
  } else {
    const float cone_width = push.pixel_size * hit.distance;
    write_surface(index, hit, surface_at(hit.mesh, hit.triangle, hit.uv, normalize(ray.direction), cone_width));
  }
}
