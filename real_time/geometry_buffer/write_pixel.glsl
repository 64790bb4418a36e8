// SPDX-License-Identifier: Apache-2.0
// What a pixel shows, as records, however it was found. Included behind scene.glsl by kernels that say what they were
// told:
//   GeometryPush frame()
#include "base/vectors.glsl"
#include "real_time/geometry_buffer/camera_ray.glsl"
#include "real_time/geometry_buffer/geometry_records.h"
#include "real_time/shading/shading_records.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Pixels { PixelRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Surfaces { SurfaceRecord value[]; };

GeometryPush frame();

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
  Pixels(frame().pixels).value[index] = pixel;
  Surfaces(frame().surfaces).value[index] = surface;
}

void write_surface(uint index, Hit hit, Surface met) {
  PixelRecord pixel;
  pixel.position = numbers(met.position);
  pixel.depth = dot(met.position - vector(frame().eye), vector(frame().forward));
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
  Pixels(frame().pixels).value[index] = pixel;
  Surfaces(frame().surfaces).value[index] = surface;
}

// The surface where the pixel's ray met something, else the sky.
void write_pixel(uint index, Ray ray, Hit hit) {
  if (hit.mesh == kNothing) {
    write_sky(index, ray.direction);
  } else {
    const float cone_width = frame().pixel_size * hit.distance;
    write_surface(index, hit, surface_at(hit.mesh, hit.triangle, hit.uv, normalize(ray.direction), cone_width));
  }
}
