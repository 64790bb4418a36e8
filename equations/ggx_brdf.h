// SPDX-License-Identifier: Apache-2.0
// The material of glTF 2.0: a diffuse base under GGX microfacets with height-correlated Smith masking and Schlick's
// Fresnel, metallic-roughness parameters, KHR_materials_specular and _ior folded into f0 and f90.
//
// One direction of the pair is fixed for many evaluations: the eye's at a pixel, the photon's at a virtual light. What
// depends on it alone is prepared once (FixedDirectionBrdf). The BRDF is reciprocal, so one function serves both ends.
#ifndef LUCIOLE_GGX_BRDF_H
#define LUCIOLE_GGX_BRDF_H
#include "equations/shading_language.h"

struct SurfaceBrdf {
  real3 diffuse_albedo;  // c_diff, linear RGB                          [1] in [0,1]
  real3 f0;              // specular reflectance at normal incidence    [1] in [0,1]
  real f90;              // specular reflectance at grazing incidence   [1] in [0,1]
  real ggx_alpha;        // [TH17] alpha, glTF's roughness squared      [1] in [0.001,1]
};

// Reflection from the fixed direction to another one, per irradiance perpendicular to the light: BRDF times cosine.
struct Reflection {
  real diffuse;    // to be multiplied by diffuse_albedo, so that a renderer can filter light without texture   [1/sr]
  real3 specular;  // [1/sr]
};

struct FixedDirectionBrdf {
  real3 normal;           // unit
  real3 fixed_direction;  // unit, away from the surface: to the eye, or back along the photon
  real3 f0;
  real f90;
  real f0_max;  // largest channel
  real alpha_sq;
  real cos_fixed;  // n . fixed, not below 0
  real masking;    // sqrt(alpha^2 + (1 - alpha^2) cos_fixed^2)
};

LUCIOLE_FN real largest_channel(real3 rgb) { return max(max(rgb.x, rgb.y), rgb.z); }

// glTF 2.0, appendix B: metallic-roughness to the parameters of the BRDF.
//   base_colour                   linear RGB                                            [1] in [0,1]
//   metallic                      0: dielectric, 1: metal                               [1] in [0,1]
//   dielectric_f0, dielectric_f90  .04 and 1, or as KHR_materials_ior and _specular say  [1] in [0,1]
// The caller sets ggx_alpha, as it comes from a texture, a shot or a recipe.
LUCIOLE_FN SurfaceBrdf metallic_roughness_brdf(real3 base_colour, real metallic, real3 dielectric_f0,
                                               real dielectric_f90, real ggx_alpha) {
  SurfaceBrdf brdf;
  brdf.diffuse_albedo = base_colour * (1.0f - metallic);
  brdf.f0 = dielectric_f0 * (1.0f - metallic) + base_colour * metallic;
  brdf.f90 = dielectric_f90 * (1.0f - metallic) + metallic;
  brdf.ggx_alpha = ggx_alpha;
  return brdf;
}

// Schlick's weight of the grazing reflectance: F = f0 (1 - w) + f90 w.
//   cos_half  cosine between either direction and the half vector  [1] in [0,1]
LUCIOLE_FN real schlick_weight(real cos_half) {
  const real m = 1.0f - cos_half;
  const real m_sq = m * m;
  return m_sq * m_sq * m;
}

// Fresnel reflectance.                                                [Schlick 1994]
LUCIOLE_FN real schlick_fresnel(real f0, real f90, real cos_half) { return f0 + (f90 - f0) * schlick_weight(cos_half); }

// Largest Fresnel reflectance over all outgoing directions above the surface.   [TH17] Eq. 9, F_max
//   cos_incident  c = w_i . n                                                     [1] in [0,1]
//   sin_incident  s                                                               [1] in [0,1]
// The half vector is farthest from w_i, by pi/4 + theta_i/2, when w_o lies on the horizon, in the plane of incidence,
// on the mirror side. Its cosine sqrt((1-s)/2) is written as c / sqrt(2 (1+s)), which does not cancel. If f90 < f0,
// Schlick's curve falls, and its maximum is f0.
LUCIOLE_FN real largest_fresnel(real f0, real f90, real cos_incident, real sin_incident) {
  const real cos_half = cos_incident * inverse_sqrt(2.0f * (1.0f + sin_incident));
  return max(f0, schlick_fresnel(f0, f90, min(cos_half, 1.0f)));
}

// GGX distribution of microfacet normals.                             [TH17] Eq. 7
//   alpha_sq    ggx_alpha squared
//   cos_m_sq    squared cosine of the angle between microfacet and surface normal
//   sin_m_sq    its squared sine, computed apart (|n x h|^2): 1 - cos^2 would lose 25 % at ggx_alpha = .001 in float
//   returns     [1/sr]
LUCIOLE_FN real ggx_distribution(real alpha_sq, real cos_m_sq, real sin_m_sq) {
  const real d = alpha_sq * cos_m_sq + sin_m_sq;
  return alpha_sq / (LUCIOLE_REAL(3.14159265358979323846) * d * d);
}

// Smith's masking of GGX.                                             [TH17] Eq. 8
//   cos_theta  between direction and surface normal  [1] in [0,1]
LUCIOLE_FN real smith_masking(real alpha_sq, real cos_theta) {
  return 2.0f * cos_theta / (cos_theta + sqrt(alpha_sq + (1.0f - alpha_sq) * cos_theta * cos_theta));
}

// What depends on the fixed direction alone.
//   normal  shading normal, unit
//   fixed_direction  unit, away from the surface
LUCIOLE_FN FixedDirectionBrdf fix_direction(SurfaceBrdf brdf, real3 normal, real3 fixed_direction) {
  FixedDirectionBrdf f;
  f.normal = normal;
  f.fixed_direction = fixed_direction;
  f.f0 = brdf.f0;
  f.f90 = brdf.f90;
  f.f0_max = largest_channel(brdf.f0);
  f.alpha_sq = brdf.ggx_alpha * brdf.ggx_alpha;
  f.cos_fixed = max(dot(normal, fixed_direction), real(0.0f));
  f.masking = sqrt(f.alpha_sq + (1.0f - f.alpha_sq) * f.cos_fixed * f.cos_fixed);
  return f;
}

// Diffuse part alone.  (1 - max_rgb F) cos / pi, to be multiplied by diffuse_albedo.   KHR_materials_specular
//   other    unit, away from the surface: to the light at a pixel, to the pixel at a light
//   returns  [1/sr]; 0 below the shading normal's horizon
LUCIOLE_FN real diffuse_reflection(FixedDirectionBrdf f, real3 other) {
  const real3 h = other + f.fixed_direction;  // half vector, not normalised: cos_half = |h|/2
  const real h_sq = dot(h, h);
  const real cos_half = 0.5f * h_sq * inverse_sqrt(max(h_sq, real(1e-20f)));
  const real largest_f = f.f0_max + (f.f90 - f.f0_max) * schlick_weight(cos_half);
  const real cos_other = max(dot(f.normal, other), real(0.0f));
  return (1.0f - largest_f) * cos_other * LUCIOLE_REAL(0.318309886183790671538);
}

// Both parts. F D G2 / (4 cos_fixed cos_other) times cos_other, [TH17] Eq. 6 with height-correlated G2 [Heitz 2014],
// with one division and two square roots in all:
//   D = alpha^2 |h|^4 / (pi (alpha^2 (n.h)^2 + |h - (n.h) n|^2)^2)       h = w_i + w_o, not normalised
//   G2 / (4 cos cos) = 1/2 / (cos_other masking(fixed) + cos_fixed masking(other))
LUCIOLE_FN Reflection reflection(FixedDirectionBrdf f, real3 other) {
  const real3 h = other + f.fixed_direction;
  const real h_sq = dot(h, h);
  const real cos_other = max(dot(f.normal, other), real(0.0f));
  const real n_h = cos_other + f.cos_fixed;
  const real3 tangential = h - f.normal * n_h;  // |n x h|, without a cross product
  const real spread = (f.alpha_sq * n_h) * n_h + dot(tangential, tangential);
  const real other_sq = f.alpha_sq + (1.0f - f.alpha_sq) * cos_other * cos_other;
  const real other_masking = other_sq * inverse_sqrt(other_sq);
  const real visibility = cos_other * f.masking + f.cos_fixed * other_masking;
  // The floor keeps 0/0 (both directions on the horizon) at 0; elsewhere the product is far above it.
  const real denominator = max((spread * spread) * visibility, real(1e-36f));
  const real lobe =
      (f.alpha_sq * LUCIOLE_REAL(0.159154943091895335769)) * (h_sq * h_sq) * cos_other * inverse(denominator);
  const real cos_half = 0.5f * h_sq * inverse_sqrt(max(h_sq, real(1e-20f)));
  const real w = schlick_weight(cos_half);
  const real grazing = f.f90 * w;
  Reflection result;
  result.specular = f.f0 * (lobe * (1.0f - w)) + real3(lobe * grazing, lobe * grazing, lobe * grazing);
  result.diffuse = (1.0f - (f.f0_max * (1.0f - w) + grazing)) * cos_other * LUCIOLE_REAL(0.318309886183790671538);
  return result;
}

// Intensity of a virtual light's diffuse lobe.                        [TH17] Eq. 4
//   f       the light's surface, fixed direction = w_i, back along the photon
//   albedo  its diffuse_albedo
//   flux    Phi of the photon, linear RGB                               [W]
//   other   w_o, unit, towards the receiver
//   returns [W/sr]
LUCIOLE_FN real3 diffuse_lobe_intensity(FixedDirectionBrdf f, real3 albedo, real3 flux, real3 other) {
  return flux * albedo * diffuse_reflection(f, other);
}

// Intensity of a virtual light's glossy lobe, Phi F D G2 / (4 c).     [TH17] Eqs. 4 and 6
LUCIOLE_FN real3 glossy_lobe_intensity(FixedDirectionBrdf f, real3 flux, real3 other) {
  return flux * reflection(f, other).specular;
}

#endif
