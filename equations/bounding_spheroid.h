// SPDX-License-Identifier: Apache-2.0
// The spheroid of [TH17]: it contains every point that a GGX lobe can reach this frame.
#ifndef LUCIOLE_BOUNDING_SPHEROID_H
#define LUCIOLE_BOUNDING_SPHEROID_H
#include "equations/ggx_brdf.h"

// What a glossy lobe's bound depends on, but for its size.
struct GlossyLobe {
  real3 position;     // q of the light                                           [m]
  real3 mirror;       // w_u = 2 c n - w_i, mirror direction of the photon         unit
  real3 across;       // w_w, across the plane of incidence                        unit, perpendicular to mirror
  real cos_incident;  // c = w_i . n                                            > 0
  real sin_incident;  // s = |w_u x n|
  real sin_sq;        // s^2, but 0 where the plane of incidence is not defined in float (s < .001)
  real alpha;         // ggx_alpha                                                 [1] in [0.001,1]
};

// One type for all bounds of glossy lobes: semi-axes along `mirror`, mirror x across, and `across`.
struct BoundingEllipsoid {
  real3 centre;  // [m]
  real3 axis_u;  // unit
  real3 axis_w;  // unit, perpendicular to axis_u; the third axis is axis_w x axis_u
  real r_u;      // [m] > 0
  real r_v;
  real r_w;
};

// A direction perpendicular to a unit vector.
LUCIOLE_FN real3 perpendicular(real3 a) {
  const real3 by_x = real3(real(0.0f), a.z, -a.y);
  const real3 by_y = real3(-a.z, real(0.0f), a.x);
  return normalize(select(abs(a.x) < 0.7f, by_x, by_y));
}

// The frame of a glossy lobe.                                          [TH17] Eq. 14
//   position   of the light                              [m]
//   normal     shading normal of its surface             unit
//   incident   w_i, back along the photon                unit; the light has no lobe unless w_i . n > 0
//   ggx_alpha  clamped to at most 1: beyond, D is not monotone and nothing below holds
LUCIOLE_FN GlossyLobe glossy_lobe(real3 position, real3 normal, real3 incident, real ggx_alpha) {
  GlossyLobe lobe;
  const real c = dot(incident, normal);
  const real3 mirror = normalize(normal * (2.0f * c) - incident);
  const real3 k = cross(mirror, normal);
  const real k_sq = dot(k, k);
  const mask plane_exists = k_sq > 1e-6f;
  // Once more perpendicular to w_u: for small s rounding tilts the cross product.
  const real3 level = k - mirror * dot(k, mirror);
  const real3 along_k = level * inverse_sqrt(max(dot(level, level), real(1e-12f)));
  lobe.position = position;
  lobe.mirror = mirror;
  lobe.across = select(plane_exists, along_k, perpendicular(mirror));
  lobe.cos_incident = max(c, real(0.0f));
  lobe.sin_incident = sqrt(k_sq);
  lobe.sin_sq = select(plane_exists, k_sq, real(0.0f));
  lobe.alpha = min(ggx_alpha, real(1.0f));
  return lobe;
}

// Reflectance at normal incidence of the one-channel lobe that bounds all three: max(Phi f0) / max(Phi). With f90 it
// gives F' such that Phi_c F_c <= max(Phi) F' for each channel c, with equality at normal and at grazing incidence.
//   flux  linear RGB, any unit, not black;  f0 of the surface
LUCIOLE_FN real bounding_f0(real3 flux, real3 f0) {
  return largest_channel(flux * f0) / max(largest_channel(flux), real(1e-30f));
}

// r^2 without Fresnel: the size of the lobe of a perfect reflector.    [TH17] Eq. 12
//   flux_per_threshold  flux_over_threshold(E Phi, delta, xi)          [m^2 sr]
//   returns             [m^2]
// paper: F Phi G1 / (4 pi delta xi c). G1 / c = 2 / (c + sqrt(c^2 + alpha^2 s^2)) has no division by c: finite at
// grazing.
LUCIOLE_FN real lobe_size_sq(GlossyLobe lobe, real flux_per_threshold) {
  const real c = lobe.cos_incident;
  const real root = sqrt(c * c + lobe.alpha * lobe.alpha * lobe.sin_incident * lobe.sin_incident);
  return flux_per_threshold * LUCIOLE_REAL(0.159154943091895335769) / (c + root);
}

// r of [TH17], with the largest Fresnel reflectance.                   [TH17] Eq. 12
//   f0, f90  bounding_f0 and f90 of the surface
//   returns  [m]
LUCIOLE_FN real lobe_size(GlossyLobe lobe, real f0, real f90, real flux_per_threshold) {
  const real f_max = largest_fresnel(f0, f90, lobe.cos_incident, lobe.sin_incident);
  return sqrt(f_max * lobe_size_sq(lobe, flux_per_threshold));
}

// Farthest reach of the lobe, at the mirror direction: radius of the sphere at the light.   [TH17] sect. 7, r / alpha
LUCIOLE_FN real glossy_reach(GlossyLobe lobe, real size) { return size / lobe.alpha; }

// The spheroid. The light is a focus; it extends from -alpha r to +r/alpha along w_u.   [TH17] Eqs. 13-15
//   size  r = lobe_size(...)  [m]
LUCIOLE_FN BoundingEllipsoid bounding_spheroid(GlossyLobe lobe, real size) {
  const real alpha_sq = lobe.alpha * lobe.alpha;
  const real half_reach = 0.5f * size / lobe.alpha;
  BoundingEllipsoid e;
  e.centre = lobe.position + lobe.mirror * ((1.0f - alpha_sq) * half_reach);
  e.axis_u = lobe.mirror;
  e.axis_w = lobe.across;
  e.r_u = (1.0f + alpha_sq) * half_reach;
  e.r_v = size;
  e.r_w = size;
  return e;
}

// Is a point inside the spheroid?  l (1 + alpha^2) - (1 - alpha^2) P.w_u <= 2 r alpha, without the cancellation of the
// two terms: for small alpha it would lose points in float.            from [TH17] Eq. 20
//   target  [m]
LUCIOLE_FN mask spheroid_contains(GlossyLobe lobe, real size, real3 target) {
  const real3 p = target - lobe.position;
  const real l = length(p);
  const real3 difference = p - lobe.mirror * l;  // l (w_o - w_u)
  const real alpha_sq = lobe.alpha * lobe.alpha;
  const real twice_sin_sq = 0.5f * dot(difference, difference) / max(l, real(1e-30f));
  return 2.0f * alpha_sq * l + (1.0f - alpha_sq) * twice_sin_sq <= 2.0f * size * lobe.alpha;
}

// Quadratic form of an ellipsoid: at most 1 inside.
//   target  [m]
//   returns [1]
LUCIOLE_FN real ellipsoid_form(BoundingEllipsoid e, real3 target) {
  const real3 d = target - e.centre;
  const real u = dot(d, e.axis_u) / e.r_u;
  const real v = dot(d, cross(e.axis_w, e.axis_u)) / e.r_v;
  const real w = dot(d, e.axis_w) / e.r_w;
  return u * u + v * v + w * w;
}

#endif
