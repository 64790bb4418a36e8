// SPDX-License-Identifier: Apache-2.0
// Light that a surface reflects straight from a point, spot or directional light, without shadows.
#ifndef LUCIOLE_PUNCTUAL_LIGHT_H
#define LUCIOLE_PUNCTUAL_LIGHT_H
#include "equations/ggx_brdf.h"

// All kinds in one form: what a direction w (towards the light) receives is
//   colour * fall_off * t^2,  t = clamp(-w . direction * scale + offset, 0, 1)
// with fall_off 1/l^2, or 1 for a sun; scale 0 and offset 1 without a cone.
struct PunctualSource {
  mask sun;
  real3 position;   // [m]; not for a sun
  real3 direction;  // unit, away from the light; not for a point
  real3 colour;     // [W/sr]; a sun's irradiance [W/m^2]
  real scale, offset;
};

// Radiance towards the eye; black where the surface does not face the light or the eye.      [W/(m^2 sr)]
//   position, geometric_normal, shading_normal  of the surface, unit normals on the eye's side
//   to_eye                                      unit
LUCIOLE_FN real3 reflected_from_source(PunctualSource source, SurfaceBrdf brdf, real3 position, real3 geometric_normal,
                                       real3 shading_normal, real3 to_eye) {
  const real3 offset = source.position - position;
  // Closer than a micrometre the fall-off stays what it is there.
  const real distance_sq = select(source.sun, real(1.0f), max(dot(offset, offset), LUCIOLE_REAL(1e-12)));
  const real3 to_light = select(source.sun, -source.direction, offset * inverse_sqrt(distance_sq));
  const real t = clamp(-dot(to_light, source.direction) * source.scale + source.offset, real(0.0f), real(1.0f));
  const Reflection reflected = reflection(fix_direction(brdf, shading_normal, to_eye), to_light);
  const real3 radiance =
      (brdf.diffuse_albedo * reflected.diffuse + reflected.specular) * source.colour * (t * t / distance_sq);
  const real zero = real(0.0f);
  const mask faces = dot(geometric_normal, to_light) > zero && dot(geometric_normal, to_eye) > zero;
  return select(faces, radiance, real3(zero, zero, zero));
}

#endif
