// SPDX-License-Identifier: Apache-2.0
// Ellipsoids that fit a GGX lobe tighter than the spheroid of [TH17]; derived in docs/mathematics.md. With P = x - q,
// l = |P|, the microfacet distribution alone has the isosurface
//   (1 + alpha^2) l - (1 - alpha^2) P.w_u + (1 - alpha^2) (P.k)^2 / (l + P.w_i) = 2 r alpha,     k = w_u x n,
// whose third term the spheroid drops: at grazing incidence the lobe is much narrower across the plane of incidence.
#ifndef LUCIOLE_TIGHT_BOUND_H
#define LUCIOLE_TIGHT_BOUND_H
#include "equations/bounding_spheroid.h"

// (1 - alpha^2) / (1 + alpha^2): eccentricity of the spheroid, whose foci are the light and a point on w_u.
LUCIOLE_FN real lobe_eccentricity(real alpha) {
  const real alpha_sq = alpha * alpha;
  return (1.0f - alpha_sq) / (1.0f + alpha_sq);
}

// The spheroid, narrowed across the plane of incidence: Q = (I - e^2 w_u w_u^T + e k k^T) / r^2. In the plane it is the
// same section, so it is the best one that keeps that section.
//   size  r = lobe_size(...)  [m]
LUCIOLE_FN BoundingEllipsoid narrowed_ellipsoid(GlossyLobe lobe, real size) {
  BoundingEllipsoid e = bounding_spheroid(lobe, size);
  e.r_w = size * inverse_sqrt(1.0f + lobe_eccentricity(lobe.alpha) * lobe.sin_sq);
  return e;
}

// Share of the lobe's cross term that the fitted ellipsoid uses: any zeta in (alpha^2 / (4 + alpha^2), 1] bounds the
// lobe, 1 is the narrowed ellipsoid. This closed form is near the least volume (.5 % above on average, 17 % at worst).
//   alpha   of the bound [1] in (0,1];  c_sq, s_sq  squared cosine and sine of incidence
LUCIOLE_FN real fitted_zeta(real alpha, real c_sq, real s_sq) {
  const real e = max(lobe_eccentricity(alpha), real(1e-6f));
  const real spread = c_sq + e * s_sq;
  const real a_spread = alpha * spread;
  const real root = sqrt(a_spread * a_spread + 4.0f * e * spread * c_sq);
  return min(alpha * (a_spread + root) / max(2.0f * e * s_sq, real(1e-20f)), real(1.0f));
}

// Ellipsoid fitted to the microfacet distribution: a little longer and wider in the plane of incidence than the
// spheroid, and narrower across, by a factor that goes to cos theta_i for small alpha.
//   lobe   its frame
//   alpha  roughness of the bound: lobe.alpha, or less tight values for tight_ellipsoid  [1] in (0,1]
//   size   r of the bound                                                                [m]
LUCIOLE_FN BoundingEllipsoid fitted_ellipsoid_of(GlossyLobe lobe, real alpha, real size) {
  const real c_sq = 1.0f - lobe.sin_sq;
  const real e = lobe_eccentricity(alpha);
  const real zeta = fitted_zeta(alpha, c_sq, lobe.sin_sq);
  const real alpha_sq = alpha * alpha;
  const real nu = 1.0f / (1.0f - 0.25f * alpha_sq * (1.0f / zeta - 1.0f));
  const real y = c_sq + zeta * lobe.sin_sq;
  const real half_reach = 0.5f * size / alpha;
  BoundingEllipsoid b;
  b.axis_u = lobe.mirror;
  b.axis_w = lobe.across;
  b.r_u = nu * (1.0f + alpha_sq) * half_reach;
  b.r_v = sqrt(nu) * size;
  b.r_w = b.r_v * sqrt(y / (y + e * lobe.sin_sq));
  b.centre = lobe.position + lobe.mirror * (2.0f * half_reach - b.r_u);
  return b;
}

// The same for a lobe with its own roughness.
//   size  r = lobe_size(...)  [m]
LUCIOLE_FN BoundingEllipsoid fitted_ellipsoid(GlossyLobe lobe, real size) {
  return fitted_ellipsoid_of(lobe, lobe.alpha, size);
}

#endif
