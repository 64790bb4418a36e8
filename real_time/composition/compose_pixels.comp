// SPDX-License-Identifier: Apache-2.0
// Pass composition on a Vulkan device: the parts of the light -> the picture. The order of additions is that of
// composition.cpp, and nothing is contracted, so that a device that rounds as the CPU does has its bits.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "real_time/composition/composition_records.h"
#include "real_time/filtering/pixel_light.glsl"
#include "real_time/geometry_buffer/geometry_records.h"

layout(local_size_x = kPictureGroupColumns, local_size_y = kPictureGroupRows) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Surfaces { SurfaceRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Filtered { PixelLight value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Colours { PixelColour value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counts { CompositionCounts value; };
layout(push_constant, scalar) uniform Push { CompositionPush push; };

Light filtered_light(uint64_t filtered_at, uint index) {
  const PixelLight light = Filtered(filtered_at).value[index];
  return Light(vector(light.diffuse), vector(light.specular));
}

// Radiance towards the eye: the demodulated light on the pixel's own albedo.
vec3 modulate(Light light, vec3 albedo) {
  precise vec3 radiance = light.diffuse * albedo + light.specular;
  return radiance;
}

vec3 indirect_radiance(uint index, vec3 albedo) {
  if (push.indirect != 0ul) return modulate(filtered_light(push.indirect, index), albedo);
  return modulate(noisy_light(push.sums, push.more_sums, push.weight, index), albedo);
}

vec3 many_radiance(uint index, vec3 albedo) {
  if (push.many != 0ul) return modulate(filtered_light(push.many, index), albedo);
  return modulate(noisy_light(push.many_sums, 0ul, push.weight, index), albedo);
}

vec3 composed(uint index) {
  const bool is_sky = !is_finite(Pixels(push.pixels).value[index].depth);
  const SurfaceRecord surface = Surfaces(push.surfaces).value[index];
  const vec3 albedo = vector(surface.diffuse_albedo);
  const vec3 direct = push.direct != 0ul ? vector(Colours(push.direct).value[index].rgb) : vec3(0.0);
  const vec3 emission = push.with_emission != 0u ? vector(surface.emission) : vec3(0.0);
  precise vec3 picture = is_sky ? vec3(0.0) : indirect_radiance(index, albedo);
  picture += direct + emission;
  if (!is_sky) picture += many_radiance(index, albedo);
  return picture;
}

void main() {
  const uvec2 at = gl_GlobalInvocationID.xy;
  if (at.x >= push.width || at.y >= push.height) return;
  const uint index = at.y * push.width + at.x;
  vec3 picture = composed(index);
  if (!is_finite(picture)) {
    atomicAdd(Counts(push.counts).value.not_finite, 1u);
    picture = vec3(0.0);
  }
  Colours(push.picture).value[index].rgb = numbers(picture);
}
