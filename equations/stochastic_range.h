// SPDX-License-Identifier: Apache-2.0
// How far a light reaches this frame, so that skipping it beyond is right on average.
//
// Two families share one idea. [TH16] roulettes the fall-off 1/l^2 alone, against a floor [1/m^2] per light; [TH17]
// roulettes the light's radiance I(w)/l^2, against a floor delta for all lights, so that the range follows the lobe.
#ifndef LUCIOLE_STOCHASTIC_RANGE_H
#define LUCIOLE_STOCHASTIC_RANGE_H
#include "equations/shading_language.h"

// Inverse-square law.                                                 [TH16] sect. 2.2
//   distance_sq  [m^2]    > 0
//   returns      [1/m^2]
LUCIOLE_FN real fall_off(real distance_sq) { return 1.0f / distance_sq; }

// Squared distance with the near field of a light that stands for a small disc: 1/(l^2 + A/pi) stays finite. Use it
// as `distance_sq` everywhere; a light is then accepted inside its point light's range only, so all bounds hold.
//   distance_sq  to the light's centre                    [m^2]
//   area         that the light stands for; 0: a point    [m^2]
LUCIOLE_FN real near_field_distance_sq(real distance_sq, real area) {
  return distance_sq + area * LUCIOLE_REAL(0.318309886183790671538);
}

// Probability that a light survives the roulette at some distance.    [TH16] Eq. 1
//   falloff      fall_off(distance_sq)                                                        [1/m^2]
//   falloff_floor  [TH16] alpha_i: a light is roulette-tested where 1/l^2 < falloff_floor     [1/m^2]  > 0
//   returns      [1]      in (0,1]
LUCIOLE_FN real survival_probability(real falloff, real falloff_floor) { return min(falloff / falloff_floor, 1.0f); }

// Fall-off under roulette; its mean over xi is the inverse-square law. [TH16] Eq. 2
//   xi       random number, one per light and frame                     [1]      in (0,1), see random_number.h
//   returns  f/p if the light survives, else 0                          [1/m^2]
LUCIOLE_FN real stochastic_fall_off(real falloff, real falloff_floor, real xi) {
  const real survivor = max(falloff_floor, falloff);
  return select(survival_probability(falloff, falloff_floor) > xi, survivor, real(0.0f));
}

// How far a light reaches this frame, squared.                        [TH16] Eq. 3
//   returns  squared distance beyond which the light is skipped         [m^2]
LUCIOLE_FN real stochastic_range_sq(real falloff_floor, real xi) { return 1.0f / (falloff_floor * xi); }

// Variance of the fall-off under roulette.                            [TH16] Eq. 4
//   returns  [1/m^4], at most (falloff_floor / 2)^2
LUCIOLE_FN real fall_off_variance(real falloff, real falloff_floor) {
  return (1.0f / survival_probability(falloff, falloff_floor) - 1.0f) * falloff * falloff;
}

// Floor that keeps the standard deviation of one light's contribution to a pixel under a bound.   [TH16] Eq. 6
//   max_error      [TH16] eps_max, per light; independent lights add in variance   [display units]
//   exposure       [TH16] E, display units per radiance                            [m^2 sr / W]
//   max_intensity  largest over directions                                         [W/sr]  > 0
//   returns        falloff_floor                                                   [1/m^2]
LUCIOLE_FN real falloff_floor_of_error(real max_error, real exposure, real max_intensity) {
  return LUCIOLE_REAL(6.28318530717958647693) * max_error / (exposure * max_intensity);
}

// The same for an area light.                                         [TH16] Eq. 7
//   average_radiance  emitted                                           [W/(m^2 sr)]
//   area              of the light                                      [m^2]
LUCIOLE_FN real falloff_floor_of_area_light(real max_error, real exposure, real average_radiance, real area) {
  return falloff_floor_of_error(max_error, exposure, average_radiance * area);
}

// [TH17] delta for the same error bound: [TH16] Eq. 6 with I(w) in place of its maximum, as p = E I / (delta l^2).
//   max_error  [display units]
//   returns    delta [display units]
LUCIOLE_FN real delta_of_error(real max_error) { return LUCIOLE_REAL(6.28318530717958647693) * max_error; }

// Radiance of a point light.                                          [TH17] Eq. 1
//   intensity    towards the receiver, linear RGB                       [W/sr]
//   distance_sq  [m^2]  > 0
LUCIOLE_FN real3 point_light_radiance(real3 intensity, real distance_sq) { return intensity * (1.0f / distance_sq); }

// What the roulette looks at: the largest channel, as the display will show it.
//   intensity  towards the receiver, linear RGB, as if not interleaved  [W/sr]
//   exposure   E                                                        [m^2 sr / W]
LUCIOLE_FN real display_intensity(real3 intensity, real exposure) {
  return exposure * max(max(intensity.x, intensity.y), intensity.z);
}

// Probability that a light is accepted at a point.                    [TH17] Eq. 2
//   peak_intensity  display_intensity towards the point                 [display units m^2]  >= 0
//   delta           roulette starts where E I / l^2 falls below it      [display units]      > 0
//   distance_sq     [m^2]  > 0
//   returns         [1]    in [0,1]
LUCIOLE_FN real acceptance_probability(real peak_intensity, real delta, real distance_sq) {
  return min(peak_intensity / (delta * distance_sq), 1.0f);
}

// Is the light accepted, p > xi?  Without a division: E I > xi delta l^2. As xi < 1, p = 1 always accepts.   [TH17] Eq.
// 3
LUCIOLE_FN mask light_is_accepted(real peak_intensity, real delta, real distance_sq, real xi) {
  return peak_intensity > (delta * xi) * distance_sq;
}

// 1/p of an accepted light, by which its radiance is multiplied.      [TH17] Eq. 3
//   returns  [1]  >= 1;  for peak_intensity > 0
LUCIOLE_FN real inverse_acceptance_probability(real peak_intensity, real delta, real distance_sq) {
  return max(delta * distance_sq * inverse(peak_intensity), real(1.0f));
}

// Squared range of a light in the direction whose intensity is given. [TH17] Eq. 5
//   returns  [m^2]
LUCIOLE_FN real directional_range_sq(real peak_intensity, real delta, real xi) { return peak_intensity / (delta * xi); }

// Everything that a lobe's range depends on but its shape: l_max^2 = flux_over_threshold * f(w_i,w_o) cos.   [TH17] Eq.
// 5
//   peak_flux  exposure times largest channel of the photon's flux       [display units m^2 sr]
//   returns    E Phi / (delta xi)                                        [m^2 sr]
LUCIOLE_FN real flux_over_threshold(real peak_flux, real delta, real xi) { return peak_flux / (delta * xi); }

// The rival: one constant range for all frames, chosen so that lights beyond are wrong by at most max_error in sum.
// The light is not divided by any probability, hence darkening.       [TH16] Appendix A
//   light_count    N                                                    [1]
//   returns        squared range                                        [m^2]
// Clamped ranges at equal cost instead use the equations above with one constant xi, and never divide by p.
LUCIOLE_FN real clamped_range_sq(real max_error, real exposure, real max_intensity, real light_count) {
  return exposure * light_count * max_intensity / (LUCIOLE_REAL(3.14159265358979323846) * max_error);
}

#endif
