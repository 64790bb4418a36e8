// SPDX-License-Identifier: Apache-2.0
// Pass direct_light: what each pixel reflects straight from the primary lights, with a shadow ray to each. The text
// follows direct_light.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "real_time/device_scene/scene.glsl"
#include "equations/punctual_light.h"
#include "real_time/direct_light/direct_records.h"
#include "real_time/geometry_buffer/geometry_records.h"
#include "real_time/shading/shading_records.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Pixels { PixelRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Surfaces { SurfaceRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Sources { DirectSource value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Radiance { float value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counter { uint value; };
layout(push_constant, scalar) uniform Push { DirectPush push; };

SceneRecord scene() { return SceneAt(push.scene).value; }

PunctualSource source_at(uint index) {
  const DirectSource from = Sources(push.sources).value[index];
  PunctualSource source;
  source.sun = from.sun != 0u;
  source.position = vector(from.position);
  source.direction = vector(from.direction);
  source.colour = vector(from.colour);
  source.scale = from.scale;
  source.offset = from.offset;
  return source;
}

bool is_shadowed(PunctualSource source, vec3 position, vec3 geometric_normal) {
  Ray ray;
  ray.origin = position + geometric_normal * push.surface_offset;
  ray.direction = source.sun ? -source.direction : source.position - ray.origin;
  ray.nearest = 0.0;
  ray.farthest = source.sun ? uintBitsToFloat(0x7f800000u) : 1.0;
  const Hit hit = trace_scene(ray, true);
  if (!hit.complete) atomicAdd(Counter(push.unfinished).value, 1u);
  return hit.mesh != kNothing;
}

void main() {
  const uint index = gl_GlobalInvocationID.x;
  if (index >= push.pixel_count) return;
  const PixelRecord pixel = Pixels(push.pixels).value[index];
  vec3 sum = vec3(0.0);
  if (push.first_source > 0u) {
    for (int c = 0; c < 3; ++c) sum[c] = Radiance(push.radiance).value[3u * index + c];
  }
  if (!isinf(pixel.depth)) {
    const vec3 position = vector(pixel.position), geometric_normal = vector(pixel.geometric_normal);
    const vec3 to_eye = normalize(vector(push.eye) - position);
    const SurfaceBrdf brdf = SurfaceBrdf(vector(Surfaces(push.surfaces).value[index].diffuse_albedo), vector(pixel.f0),
                                         pixel.f90, pixel.ggx_alpha);
    for (uint i = push.first_source; i < push.first_source + push.source_count; ++i) {
      const PunctualSource source = source_at(i);
      const vec3 radiance =
          reflected_from_source(source, brdf, position, geometric_normal, vector(pixel.normal), to_eye);
      if (radiance.x + radiance.y + radiance.z > 0.0 && !is_shadowed(source, position, geometric_normal)) {
        sum += radiance;
      }
    }
  }
  for (int c = 0; c < 3; ++c) Radiance(push.radiance).value[3u * index + c] = sum[c];
}
