// SPDX-License-Identifier: Apache-2.0
// How coarse a texture is looked at: the one formula for it that every pass uses.
#ifndef LUCIOLE_TEXTURE_LEVEL_OF_DETAIL_H
#define LUCIOLE_TEXTURE_LEVEL_OF_DETAIL_H
#include "equations/shading_language.h"

// log2 of the footprint of a ray cone in texels of the finest level.
// [AM19] Akenine-Moeller et al., "Texture Level of Detail Strategies for Real-Time Ray Tracing", Ray Tracing Gems
// (2019), Eqs. 20.2, 20.3 and 20.34 with the two logarithms joined into one:
//   1/2 log2(texels per area) + log2(width / |cos|)  =  1/2 log2(texels_per_area * (width / cos)^2)
//   uv_area_per_area    area of a triangle in texture space over its area in the world   [1/m^2]  >= 0
//   texel_count         width * height of the finest level                               [1]      >= 1
//   cone_width          diameter of the cone at the hit; 0: the finest level             [m]
//   cos_at_surface      |cosine| between ray and geometric normal                        [1]
//   returns             <= 0 where the finest level is magnified
LUCIOLE_FN real texture_level_of_detail(real uv_area_per_area, real texel_count, real cone_width, real cos_at_surface) {
  // At grazing incidence the footprint is long and thin; 1/32 keeps an isotropic look-up from blurring to one colour.
  const real spread = cone_width / max(cos_at_surface, real(1.0f / 32.0f));
  const real footprint = uv_area_per_area * texel_count * spread * spread;
  const real least = real(1e-12f);
  return select(footprint > least, 0.5f * log2(max(footprint, least)), real(-20.0f));
}

#endif
