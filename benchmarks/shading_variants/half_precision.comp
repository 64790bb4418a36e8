// SPDX-License-Identifier: Apache-2.0
// The pixel's Fresnel reflectance in half precision. The lobe stays in float: its alpha^2, 10^-6 for the smoothest
// surfaces, lies below what half holds.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
#include "equations/light_emission.h"

// As reflection of equations/ggx_brdf.h.
Reflection reflection_in_half(FixedDirectionBrdf f, vec3 other) {
  const vec3 h = other + f.fixed_direction;
  const float h_sq = dot(h, h);
  const float cos_other = max(dot(f.normal, other), 0.0);
  const float n_h = cos_other + f.cos_fixed;
  const vec3 tangential = h - f.normal * n_h;
  const float spread = (f.alpha_sq * n_h) * n_h + dot(tangential, tangential);
  const float other_sq = f.alpha_sq + (1.0 - f.alpha_sq) * cos_other * cos_other;
  const float visibility = cos_other * f.masking + f.cos_fixed * (other_sq * inverse_sqrt(other_sq));
  const float lobe = (f.alpha_sq * 0.159154943) * (h_sq * h_sq) * cos_other *
                     inverse(max((spread * spread) * visibility, 1e-36));
  const float16_t m = float16_t(1.0 - 0.5 * h_sq * inverse_sqrt(max(h_sq, 1e-20)));
  const float16_t m_sq = m * m, w = m_sq * m_sq * m, one = float16_t(1.0);
  const float16_t grazing = float16_t(f.f90) * w;
  Reflection result;
  result.specular = lobe * vec3(f16vec3(f.f0) * (one - w) + f16vec3(grazing));
  result.diffuse = float(one - (float16_t(f.f0_max) * (one - w) + grazing)) * cos_other * 0.318309886;
  return result;
}

#define reflection reflection_in_half  // at pixels: the lobes of lights are in the text above
#include "benchmarks/shading_variants/variant.glsl"
#include "real_time/shading/tile_loop.glsl"

void main() {
  const TilePixel pixel = read_pixel(gl_WorkGroupID);
  shade_tile(gl_WorkGroupID, gl_NumWorkGroups, pixel, halve(pixel));
}
