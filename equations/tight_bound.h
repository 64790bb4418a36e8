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
  const real c_sq = lobe.cos_incident * lobe.cos_incident;
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
  // Float's rounding of the axes tilts the long one: at alpha = .001 and grazing incidence r_w is 1e-6 of r_u.
  const real tilt = 5e-7f * b.r_u;
  const real in_plane = sqrt(nu) * size;
  b.r_v = in_plane + tilt;
  b.r_w = in_plane * sqrt(y / (y + e * lobe.sin_sq)) + tilt;
  b.centre = lobe.position + lobe.mirror * (2.0f * half_reach - b.r_u);
  return b;
}

// The same for a lobe with its own roughness.
//   size  r = lobe_size(...)  [m]
LUCIOLE_FN BoundingEllipsoid fitted_ellipsoid(GlossyLobe lobe, real size) {
  return fitted_ellipsoid_of(lobe, lobe.alpha, size);
}

// Cells of tight_ellipsoid. Mean volume over the spheroid's at f0 = .04, ggx_alpha = .05 | .2 | 1:
//   8 x 4   .313 | .337 | .307       12 x 6  .306 | .305 | .289       16 x 8  .298 | .294 | .282       limit  .28
#define LUCIOLE_MICROFACET_CELLS 12
#define LUCIOLE_HALF_ANGLE_CELLS 6

// A range of angles between microfacet and surface normal.
struct MicrofacetCell {
  real cos_first, sin_first;  // end next to the normal
  real cos_last, sin_last;
};

// Upper bound of F G2 / G1(w_i) over all directions whose microfacet normal lies in a cell. With the identity
// cos_o = 2 cos_half cos_m - cos_i, it is a product of two functions of cos_half: Schlick's F, convex and falling,
// under its chord; and masking, concave and rising, under its tangent at the upper end. The product of the two lines
// has its maximum in closed form. Sub-ranges are shorter near the horizon, where both change fastest.
//   lobe, f0, f90  as for lobe_size, f90 >= f0
//   masking        sqrt(alpha^2 + (1 - alpha^2) c^2)
LUCIOLE_FN real fresnel_masking_bound(GlossyLobe lobe, real f0, real f90, real masking, MicrofacetCell cell) {
  const real c = lobe.cos_incident;
  const real s = lobe.sin_incident;
  const real alpha_sq = lobe.alpha * lobe.alpha;
  // Largest cos_half: the microfacet leans towards w_i, in the plane of incidence; 1 if w_i itself is in the cell.
  const real before = c * cell.cos_last + s * cell.sin_last;
  const real after = c * cell.cos_first + s * cell.sin_first;
  const real leaning = select(c < cell.cos_last, before, select(c > cell.cos_first, after, real(1.0f)));
  const real cos_high = min(leaning, real(1.0f));
  // Least: it leans away; but w_o stays above the surface.
  const real horizon = 0.5f * c / cell.cos_first;
  const real cos_low = min(max(c * cell.cos_last - s * cell.sin_last, horizon), cos_high);
  const real g_scale = (c + masking) * c * alpha_sq * 2.0f * cell.cos_first;
  real low = cos_low;
  real f_low = schlick_fresnel(f0, f90, low);
  real share = 0.0f;
  real largest = 0.0f;
  for (int i = 0; i < LUCIOLE_HALF_ANGLE_CELLS; ++i) {
    share = share + 1.0f / LUCIOLE_HALF_ANGLE_CELLS;
    const real high = cos_low + (cos_high - cos_low) * share * share;
    const real f_high = schlick_fresnel(f0, f90, high);
    // g(z) = G2/G1(w_i) = (1 + L_i) / (1 + L_i + L(z)), and its slope per sub-range.
    const real z = max(2.0f * high * cell.cos_first - c, real(0.0f));
    const real z_masking_sq = alpha_sq + (1.0f - alpha_sq) * z * z;
    const real inverse_masking = inverse_sqrt(z_masking_sq);
    const real inverse_sum = inverse(z * masking + c * z_masking_sq * inverse_masking);
    const real g = (c + masking) * z * inverse_sum;
    const real g_fall = g_scale * (high - low) * inverse_sum * inverse_sum * inverse_masking;
    const real f_rise = f_low - f_high;
    const real peak = 0.5f * (f_rise * g - f_high * g_fall) * inverse(max(f_rise * g_fall, real(1e-20f)));
    const real at = clamp(peak, real(0.0f), real(1.0f));
    largest = max(largest, (f_high + f_rise * at) * (g - g_fall * at));
    low = high;
    f_low = f_high;
  }
  return largest * 1.00002f;  // rounding
}

// End number i of the cells: tan = alpha tan(psi), psi almost uniform up to the steepest microfacet that can be lit,
// tan(theta_max) = (1+s)/c, which the caller sets as the last end. Written with tan(psi/2), so that it needs no
// trigonometric function.
//   half_step  tan(psi_max/2) / cells
//   returns    squared tangent
LUCIOLE_FN real microfacet_tan_sq(real alpha, real half_step, real i) {
  const real h = half_step * i;
  const real t = 2.0f * alpha * h / max(1.0f - h * h, real(1e-6f));
  return t * t;
}

// Roughness and size of a GGX distribution whose lobe contains another lobe.
struct LobeShape {
  real alpha;  // [1] in (0,1]
  real size;   // r of its bound  [m]
};

// Product of the semi-axes of fitted_ellipsoid_of.
LUCIOLE_FN real fitted_volume(GlossyLobe lobe, LobeShape shape) {
  const BoundingEllipsoid e = fitted_ellipsoid_of(lobe, shape.alpha, shape.size);
  return e.r_u * e.r_v * e.r_w;
}

// Limits A + 2 B t <= limit(t) of tight_ellipsoid at the ends of the cells.
struct LobeLimits {
  real sin_sq[LUCIOLE_MICROFACET_CELLS + 1];  // t
  real limit[LUCIOLE_MICROFACET_CELLS + 1];   // (alpha + (1 - alpha^2) t / alpha) / sqrt(M), the smaller of two cells
  real first_scale;                           // 1 / sqrt(M) of the first cell
  real least_scale;
};

LUCIOLE_FN LobeLimits lobe_limits(GlossyLobe lobe, real f0, real f90) {
  const real alpha_sq = lobe.alpha * lobe.alpha;
  const real c = lobe.cos_incident;
  const real masking = sqrt(alpha_sq + (1.0f - alpha_sq) * c * c);
  const real tan_max = (1.0f + lobe.sin_incident) / max(c, real(1e-12f));
  const real tan_psi = tan_max / lobe.alpha;
  const real half_step = tan_psi / (1.0f + sqrt(1.0f + tan_psi * tan_psi)) * (1.0f / LUCIOLE_MICROFACET_CELLS);
  const real slope = (1.0f - alpha_sq) / lobe.alpha;
  LobeLimits limits;
  limits.least_scale = 1e6f;
  limits.sin_sq[0] = 0.0f;
  MicrofacetCell cell;
  cell.cos_last = 1.0f;
  cell.sin_last = 0.0f;
  real scale_before = 1e6f;
  real index = 0.0f;
  for (int j = 0; j < LUCIOLE_MICROFACET_CELLS; ++j) {
    cell.cos_first = cell.cos_last;
    cell.sin_first = cell.sin_last;
    index = index + 1.0f;
    const real tan_sq =
        j + 1 < LUCIOLE_MICROFACET_CELLS ? microfacet_tan_sq(lobe.alpha, half_step, index) : tan_max * tan_max;
    cell.cos_last = inverse_sqrt(1.0f + tan_sq);
    limits.sin_sq[j + 1] = tan_sq * cell.cos_last * cell.cos_last;
    cell.sin_last = sqrt(limits.sin_sq[j + 1]);
    const real scale = inverse_sqrt(max(fresnel_masking_bound(lobe, f0, f90, masking, cell), real(1e-12f)));
    limits.limit[j] = (lobe.alpha + slope * limits.sin_sq[j]) * min(scale_before, scale);
    limits.first_scale = j == 0 ? scale : limits.first_scale;
    limits.least_scale = min(limits.least_scale, scale);
    scale_before = scale;
  }
  limits.limit[LUCIOLE_MICROFACET_CELLS] =
      (lobe.alpha + slope * limits.sin_sq[LUCIOLE_MICROFACET_CELLS]) * scale_before;
  return limits;
}

// Ellipsoid fitted to the whole lobe: distribution, Fresnel and masking. Per cell of microfacet angles, with t the
// squared sine, F G2/G1 <= M; the distribution of roughness alpha*^2 = A/(A+2B) and size r* = r alpha*/A bounds the
// lobe if
//   A + 2 B t <= (alpha + (1-alpha^2) t/alpha) / sqrt(M)
// at both ends of every cell, as both sides are linear in t. Any B >= 0 is valid: a few are tried, the least volume is
// kept. Never larger than fitted_ellipsoid.
//   f0, f90               bounding_f0 and f90 of the surface
//   flux_per_threshold    flux_over_threshold(E Phi, delta, xi)   [m^2 sr]
// About 4,000 operations without a branch, once per light and frame: docs/mathematics.md has the measured time.
LUCIOLE_FN BoundingEllipsoid tight_ellipsoid(GlossyLobe lobe, real f0, real f90, real flux_per_threshold) {
  const LobeLimits limits = lobe_limits(lobe, f0, max(f0, f90));
  const real size = sqrt(lobe_size_sq(lobe, flux_per_threshold));
  const real b_low = 0.5f * (1.0f - lobe.alpha * lobe.alpha) / lobe.alpha * limits.least_scale;
  const real b_step = sqrt(sqrt(limits.first_scale / limits.least_scale));
  LobeShape best;
  best.alpha = lobe.alpha;
  best.size = lobe_size(lobe, f0, f90, flux_per_threshold);
  real best_volume = fitted_volume(lobe, best);
  real b = b_low;
  real share = 1.0f;
  for (int i = 0; i < 10; ++i) {
    real a = 1e30f;
    for (int j = 0; j <= LUCIOLE_MICROFACET_CELLS; ++j) {
      a = min(a, limits.limit[j] - 2.0f * b * limits.sin_sq[j]);
    }
    const mask valid = a > 1e-12f;
    a = max(a * 0.99999f, real(1e-12f));  // rounding
    LobeShape shape;
    shape.alpha = sqrt(a / (a + 2.0f * b));
    shape.size = size * shape.alpha / a;
    const real volume = fitted_volume(lobe, shape);
    const mask better = valid && volume < best_volume;
    best.alpha = select(better, shape.alpha, best.alpha);
    best.size = select(better, shape.size, best.size);
    best_volume = select(better, volume, best_volume);
    // Five values from b_low up to that of the first cell, then five below b_low, the last is 0.
    share = i < 4 ? share : share - 0.2f;
    b = i < 4 ? b * b_step : b_low * max(share, real(0.0f));
  }
  return fitted_ellipsoid_of(lobe, best.alpha, best.size);
}

#endif
