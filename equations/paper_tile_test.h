// SPDX-License-Identifier: Apache-2.0
// The tile test of [TH17] sect. 5, as the paper writes it: stretch, rotate, box of the corners, for two depth halves.
// It is the measure that tile_test.h is compared with.
#ifndef LUCIOLE_PAPER_TILE_TEST_H
#define LUCIOLE_PAPER_TILE_TEST_H
#include "equations/tile_test.h"

struct PaperTestEllipsoid {
  real3 row_x, row_y, row_z;  // B S  [1/m]
  real3 stretched;            // B S c', centre of the unit sphere
};

// B S and B S c'.                                                     [TH17] Eqs. 16 and 17
// Semi-axes grow as in prepare_ellipsoid, so that float loses no light.
LUCIOLE_FN PaperTestEllipsoid prepare_ellipsoid_as_paper(ViewFrame view, BoundingEllipsoid e) {
  const real3 centre = view_from_world(view, e.centre);
  const real guard = 4e-6f * length(centre);
  const real3 u = view_from_world_direction(view, e.axis_u);
  const real3 w = view_from_world_direction(view, e.axis_w);
  const real3 v = cross(w, u);
  const real3 su = u * (1.0f / (e.r_u * 1.0001f + guard));
  const real3 sv = v * (1.0f / (e.r_v * 1.0001f + guard));
  const real3 sw = w * (1.0f / (e.r_w * 1.0001f + guard));
  const real3 bx = su * u.x + sv * v.x + sw * w.x;  // columns of S = R diag(1/r) R^T
  const real3 by = su * u.y + sv * v.y + sw * w.y;
  const real3 bq = su * u.z + sv * v.z + sw * w.z;
  const real3 bz = cross(bx, by);
  const mask x_first = dot(bx, bx) > dot(by, by);
  const real3 unit_z = normalize(bz);
  const real3 unit_x = select(x_first, normalize(bx), normalize(cross(by, bz)));
  const real3 unit_y = select(x_first, normalize(cross(bz, bx)), normalize(by));
  PaperTestEllipsoid t;
  t.row_x = real3(dot(unit_x, bx), dot(unit_x, by), dot(unit_x, bq));
  t.row_y = real3(dot(unit_y, bx), dot(unit_y, by), dot(unit_y, bq));
  t.row_z = real3(dot(unit_z, bx), dot(unit_z, by), dot(unit_z, bq));
  t.stretched = real3(dot(t.row_x, centre), dot(t.row_y, centre), dot(t.row_z, centre));
  return t;
}

// A sphere needs no stretching: the test with rows 1/r.
LUCIOLE_FN PaperTestEllipsoid prepare_sphere_as_paper(ViewFrame view, BoundingSphere sphere) {
  const real3 centre = view_from_world(view, sphere.centre);
  const real scale = 1.0f / (sphere.radius * 1.0001f + 4e-6f * length(centre));
  PaperTestEllipsoid t;
  t.row_x = real3(scale, real(0.0f), real(0.0f));
  t.row_y = real3(real(0.0f), scale, real(0.0f));
  t.row_z = real3(real(0.0f), real(0.0f), scale);
  t.stretched = centre * scale;
  return t;
}

// Distance along one axis of the test space from the sphere's centre to the box of the 8 corners.
//   row     of B S
//   centre  coordinate of the sphere's centre
LUCIOLE_FN real corner_box_gap(real3 row, real centre, Tile tile, real depth_low, real depth_high) {
  const real low = min(row.x * tile.x_low, row.x * tile.x_high) + min(row.y * tile.y_low, row.y * tile.y_high) + row.z;
  const real high = max(row.x * tile.x_low, row.x * tile.x_high) + max(row.y * tile.y_low, row.y * tile.y_high) + row.z;
  const real gap =
      max(min(low * depth_low, low * depth_high) - centre, centre - max(high * depth_low, high * depth_high));
  return max(gap, real(0.0f));
}

LUCIOLE_FN mask paper_test_of_half(PaperTestEllipsoid t, Tile tile, real depth_low, real depth_high) {
  const real x = corner_box_gap(t.row_x, t.stretched.x, tile, depth_low, depth_high);
  const real y = corner_box_gap(t.row_y, t.stretched.y, tile, depth_low, depth_high);
  const real z = corner_box_gap(t.row_z, t.stretched.z, tile, depth_low, depth_high);
  return x * x + y * y + z * z <= 1.0002f && depth_low <= depth_high;
}

// Modified HalfZ: both halves of the tile's depth range.              [TH17] sect. 5.1
LUCIOLE_FN HalfMasks touches_tile_as_paper(PaperTestEllipsoid t, Tile tile) {
  HalfMasks touches;
  touches.near_half = paper_test_of_half(t, tile, tile.near_low, tile.near_high);
  touches.far_half = paper_test_of_half(t, tile, tile.far_low, tile.far_high);
  return touches;
}

#endif
