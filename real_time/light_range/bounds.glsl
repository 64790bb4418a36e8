// SPDX-License-Identifier: Apache-2.0
// The bounds of lights as culling kernels read them (emitters.h), entry by entry. Included after the push constants, of
// which it reads `bounds`.
#include "equations/tile_test.h"
#include "real_time/light_range/emitters.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Bounds { BoundBlock block[]; };

float bound_row(uint entry, int row) { return Bounds(push.bounds).block[entry / 16u].row[row][entry % 16u]; }
vec3 bound_rows(uint entry, int row) {
  return vec3(bound_row(entry, row), bound_row(entry, row + 1), bound_row(entry, row + 2));
}

TileTestEllipsoid load_ellipsoid(uint entry) {
  const vec3 m0 = bound_rows(entry, kM00), m1 = bound_rows(entry, kM11), s = bound_rows(entry, kSxx);
  TileTestEllipsoid t;
  t.factor = TriangularFactor(m0.x, m0.y, m0.z, m1.x, m1.y, m1.z);
  t.stretched = bound_rows(entry, kStretchedX);
  t.centre = bound_rows(entry, kCentreX);
  t.sxx = s.x;
  t.sxz = s.y;
  t.syy = s.z;
  t.syz = bound_row(entry, kSyz);
  t.szz = bound_row(entry, kSzz);
  t.surface = SurfacePlane(bound_rows(entry, kNormalX), bound_row(entry, kNormalOffset));
  return t;
}
