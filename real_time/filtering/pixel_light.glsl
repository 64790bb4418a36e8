// SPDX-License-Identifier: Apache-2.0
// The noisy light of pixels, from the sums that shading or accumulation left; read by kernels.
#include "base/vectors.glsl"
#include "real_time/filtering/filter_records.h"
#include "real_time/shading/shading_records.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Pixels { PixelRecord value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Sums { PixelSums value[]; };

// By its bits: what arithmetic says of numbers that are none is up to the device.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

// Demodulated as in radiance.h.
struct Light {
  vec3 diffuse, specular;
};
bool is_finite(Light light) { return is_finite(light.diffuse) && is_finite(light.specular); }

const Light kDarkness = Light(vec3(0.0), vec3(0.0));

// Of a pixel with a surface: nobody writes the sums of the sky. The sums are added where more than one kind of light
// has some; an address of 0: none. Products are rounded before they are added, as on the CPU.
Light noisy_light(uint64_t sums_at, uint64_t more_sums_at, float weight, uint index) {
  precise Light light = kDarkness;
  if (sums_at != 0ul) {
    const PixelSums sums = Sums(sums_at).value[index];
    light.diffuse = vector(sums.diffuse) * weight;
    light.specular = vector(sums.specular) * weight;
  }
  if (more_sums_at != 0ul) {
    const PixelSums more = Sums(more_sums_at).value[index];
    light.diffuse += vector(more.diffuse) * weight;
    light.specular += vector(more.specular) * weight;
  }
  return light;
}
