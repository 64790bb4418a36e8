// SPDX-License-Identifier: Apache-2.0
// Shading normals: interpolated over a triangle, bent by a normal map, kept visible.
#ifndef LUCIOLE_SHADING_NORMAL_H
#define LUCIOLE_SHADING_NORMAL_H
#include "equations/shading_language.h"

// A vector at length 1, or another one where it has no direction.
LUCIOLE_FN real3 normalize_or(real3 v, real3 otherwise) {
  const real size_sq = dot(v, v), least_sq = real(1e-12f);
  return select(size_sq > least_sq, v * inverse_sqrt(max(size_sq, least_sq)), otherwise);
}

// The interpolated normal, bent by the normal map.
//   normal      interpolated, unit
//   tangent     interpolated; as in MikkTSpace it is used as it is
//   handedness  of the tangent, +1 or -1
//   texel       of the normal map, linear  [1] in [0,1]
//   scale       of the map's part along the surface  [1]
LUCIOLE_FN real3 mapped_normal(real3 normal, real3 tangent, real handedness, real3 texel, real scale) {
  const real x = (2.0f * texel.x - 1.0f) * scale, y = (2.0f * texel.y - 1.0f) * scale;
  const real3 bitangent = cross(normal, tangent) * handedness;
  const real3 bent = tangent * x + bitangent * y + normal * max(2.0f * texel.z - 1.0f, real(0.0f));
  return normalize_or(bent, normal);
}

// Bends a shading normal as little as needed, so that triangle and viewer both lie on its positive side; else the
// pixel would be black where the interpolated surface turns away before the triangle does.
//   normal, geometric_normal, to_viewer  unit; geometric_normal . to_viewer >= 0
LUCIOLE_FN real3 kept_visible(real3 normal, real3 geometric_normal, real3 to_viewer) {
  const real least_cosine = real(0.01f), none = real(0.0f);
  const real3 facing = normal + geometric_normal * max(least_cosine - dot(normal, geometric_normal), none);
  // to_viewer . geometric_normal >= 0: this step does not undo the one before.
  return normalize(facing + to_viewer * max(least_cosine - dot(facing, to_viewer), none));
}

#endif
