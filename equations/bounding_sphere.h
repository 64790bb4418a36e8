// SPDX-License-Identifier: Apache-2.0
// Spheres that contain every point that a light's lobe can reach this frame.
#ifndef LUCIOLE_BOUNDING_SPHERE_H
#define LUCIOLE_BOUNDING_SPHERE_H
#include "equations/bounding_spheroid.h"

struct BoundingSphere {
  real3 centre;  // [m]
  real radius;   // [m]
};

// Largest channel of the diffuse lobe's flux times reflectance, with the least share that the specular part takes.
//   peak_flux_albedo  largest channel of exposure * flux * diffuse_albedo           [display units m^2 sr]
//   f0_max, f90       of the surface; (1 - max F) is at most 1 - min(f0_max, f90)   [1]
LUCIOLE_FN real diffuse_peak_flux(real peak_flux_albedo, real f0_max, real f90) {
  return peak_flux_albedo * (1.0f - min(f0_max, f90));
}

// Reach of a diffuse lobe along its normal: l_max^2 = Phi k cos / (pi delta xi) at cos = 1.   [TH17] sects. 3.2 and 6
//   reach_flux  diffuse_peak_flux over delta xi   [m^2 sr]
//   returns     [m]
LUCIOLE_FN real diffuse_reach(real reach_flux) { return sqrt(reach_flux * LUCIOLE_REAL(0.318309886183790671538)); }

// Sphere around the isosurface of a diffuse lobe, l = reach sqrt(cos).  It is the smallest one: it touches where
// cos = 1/sqrt(3).                                                    [TH17] sect. 6
//   position, normal  of the light       [m], unit
//   reach             diffuse_reach      [m]
LUCIOLE_FN BoundingSphere diffuse_bounding_sphere(real3 position, real3 normal, real reach) {
  BoundingSphere sphere;
  sphere.centre = position + normal * (LUCIOLE_REAL(0.438691337650830853) * reach);  // (1/3)^(3/4)
  sphere.radius = LUCIOLE_REAL(0.620403239401120135) * reach;                        // (4/27)^(1/4)
  return sphere;
}

// Sphere around a light, by its largest intensity, as [TH16] does for every light.   [TH17] Fig. 9 a
//   reach  diffuse_reach, or glossy_reach of the glossy lobe  [m]
LUCIOLE_FN BoundingSphere sphere_at_light(real3 position, real reach) {
  BoundingSphere sphere;
  sphere.centre = position;
  sphere.radius = reach;
  return sphere;
}

// The other way round: a sphere is an ellipsoid with any axes.
LUCIOLE_FN BoundingEllipsoid ellipsoid_of(BoundingSphere sphere) {
  BoundingEllipsoid e;
  e.centre = sphere.centre;
  e.axis_u = real3(1.0f, 0.0f, 0.0f);
  e.axis_w = real3(0.0f, 1.0f, 0.0f);
  e.r_u = sphere.radius;
  e.r_v = sphere.radius;
  e.r_w = sphere.radius;
  return e;
}

// A rare random number near 0 gives a range whose square a float cannot hold. Beyond this radius, far outside any
// scene, a sphere round the light is as good.
//   position  of the light  [m]
LUCIOLE_FN BoundingEllipsoid bound_within_float(BoundingEllipsoid e, real3 position) {
  const real largest = 1e8f;                                  // [m]
  const mask fits = max(max(e.r_u, e.r_v), e.r_w) < largest;  // false for infinity and for what is no number
  e.centre = select(fits, e.centre, position);
  e.r_u = select(fits, e.r_u, largest);
  e.r_v = select(fits, e.r_v, largest);
  e.r_w = select(fits, e.r_w, largest);
  return e;
}

// Sphere around an ellipsoid; around [TH17]'s spheroid it has radius r_u.   [TH17] Fig. 9 b
LUCIOLE_FN BoundingSphere sphere_around(BoundingEllipsoid e) {
  BoundingSphere sphere;
  sphere.centre = e.centre;
  sphere.radius = max(max(e.r_u, e.r_v), e.r_w);
  return sphere;
}

#endif
