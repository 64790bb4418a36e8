// SPDX-License-Identifier: Apache-2.0
// What a light sends towards a point, and whether the point accepts it this frame. One form for all kinds of lights:
// the radiant intensity is colour * factor, and one number, the peak, decides the roulette.
#ifndef LUCIOLE_LIGHT_EMISSION_H
#define LUCIOLE_LIGHT_EMISSION_H
#include "equations/ggx_brdf.h"
#include "equations/stochastic_range.h"

struct Emitted {
  real3 colour;  // [W/sr]
  real factor;   // of the colour; 0 where the light does not shine  [1]
  real peak;     // E I / delta with the largest channel of I: p = min(peak / l^2, 1)  [m^2]
};

// Diffuse lobe of a virtual point light.                              [TH17] Eqs. 2 and 4
//   surface            fixed direction = w_i, back along the photon; of f0 only f0_max is read
//   geometric_normal   of the surface, unit
//   intensity          flux * diffuse_albedo, linear RGB                                  [W]
//   probability_scale  E / delta times largest channel of `intensity`                     [m^2 sr]
//   from_light         w_o, unit
LUCIOLE_FN Emitted emitted_by_diffuse_lobe(FixedDirectionBrdf surface, real3 geometric_normal, real3 intensity,
                                           real probability_scale, real3 from_light) {
  Emitted e;
  e.colour = intensity;
  e.factor = select(dot(geometric_normal, from_light) > 0.0f, diffuse_reflection(surface, from_light), real(0.0f));
  e.peak = e.factor * probability_scale;
  return e;
}

// Glossy lobe: which channel is the largest varies with direction.    [TH17] Eqs. 2, 4 and 6
//   flux               Phi of the photon, linear RGB                                      [W]
//   probability_scale  E / delta                                                          [m^2 sr / W]
LUCIOLE_FN Emitted emitted_by_glossy_lobe(FixedDirectionBrdf surface, real3 geometric_normal, real3 flux,
                                          real probability_scale, real3 from_light) {
  Emitted e;
  e.colour = flux * reflection(surface, from_light).specular;
  e.factor = select(dot(geometric_normal, from_light) > 0.0f, real(1.0f), real(0.0f));
  e.peak = e.factor * largest_channel(e.colour) * probability_scale;
  return e;
}

// How points, spots and emitting surfaces shine, in one form: intensity * s(t), t = clamp(max(c, -c two_sided) scale +
// offset, 0, 1), c the cosine to the axis; s(t) = t for squared = 0 and t^2 for squared = 1.
struct AxialEmission {
  real3 axis;  // unit
  real scale, offset, two_sided, squared;
};

// A punctual light, or a point of an emitting triangle.
//   intensity          largest over directions, linear RGB                                [W/sr]
//   probability_scale  E / delta times largest channel of `intensity`                     [m^2]
LUCIOLE_FN Emitted emitted_along_axis(AxialEmission light, real3 intensity, real probability_scale, real3 from_light) {
  const real c = dot(light.axis, from_light);
  const real t = clamp(max(c, -c * light.two_sided) * light.scale + light.offset, real(0.0f), real(1.0f));
  Emitted e;
  e.colour = intensity;
  e.factor = t * (1.0f + (t - 1.0f) * light.squared);
  e.peak = e.factor * probability_scale;
  return e;
}

// p > xi.                                                             [TH17] Eqs. 2 and 3
//   l_sq  squared distance, with the near field's disc  [m^2]
LUCIOLE_FN mask emission_is_accepted(Emitted e, real l_sq, real xi) { return e.peak > l_sq * xi; }

// Fall-off over probability of an accepted light, 1 / (l^2 p).        [TH17] Eq. 3
//   returns  [1/m^2]
LUCIOLE_FN real fall_off_over_probability(Emitted e, real l_sq) { return inverse(min(l_sq, e.peak)); }

#endif
