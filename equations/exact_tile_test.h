// SPDX-License-Identifier: Apache-2.0
// Exact test of an ellipsoid against a part of a tile's frustum: the floor that the cheap tests are measured against.
// Ten times their cost. Stretched by its triangular factor the ellipsoid is a unit sphere and the frustum a hexahedron
// with plane faces; the distance to it is attained on an edge or inside a face.
#ifndef LUCIOLE_EXACT_TILE_TEST_H
#define LUCIOLE_EXACT_TILE_TEST_H
#include "equations/tile_test.h"

// Squared distance from the origin to a segment.
LUCIOLE_FN real segment_distance_sq(real3 a, real3 b) {
  const real3 d = b - a;
  const real t = clamp(-dot(a, d) / max(dot(d, d), real(1e-30f)), real(0.0f), real(1.0f));
  const real3 p = a + d * t;
  return dot(p, p);
}

// Squared distance from the origin to a plane convex quadrilateral, if the foot of the perpendicular is inside; else
// huge.
LUCIOLE_FN real quad_interior_distance_sq(real3 a, real3 b, real3 c, real3 d) {
  const real3 n = cross(c - a, d - b);
  const real n_sq = max(dot(n, n), real(1e-30f));
  const real height = dot(a, n);
  // Sides seen from the foot p of the perpendicular: (b - a) x (p - a) . n = (a x b) . n, as p is parallel to n.
  const real first = min(dot(cross(a, b), n), dot(cross(b, c), n));
  const real second = min(dot(cross(c, d), n), dot(cross(d, a), n));
  return select(min(first, second) >= 0.0f, height * height / n_sq, real(1e30f));
}

// A corner of the frustum, stretched, relative to the centre of the unit sphere.
LUCIOLE_FN real3 stretched_corner(TileTestEllipsoid t, real x_slope, real y_slope, real depth) {
  const TriangularFactor m = t.factor;
  const real3 slope = real3(m.m00 * x_slope + m.m01 * y_slope + m.m02, m.m11 * y_slope + m.m12, m.m22);
  return slope * depth - t.stretched;
}

// Squared distance, in the stretched space, between the ellipsoid's centre and a part of the frustum: the two touch if
// it is at most 1.
//   depth_low <= depth_high  [m]
LUCIOLE_FN real exact_distance_sq(TileTestEllipsoid t, Tile tile, real depth_low, real depth_high) {
  const real3 n0 = stretched_corner(t, tile.x_low, tile.y_low, depth_low);
  const real3 n1 = stretched_corner(t, tile.x_high, tile.y_low, depth_low);
  const real3 n2 = stretched_corner(t, tile.x_high, tile.y_high, depth_low);
  const real3 n3 = stretched_corner(t, tile.x_low, tile.y_high, depth_low);
  const real3 f0 = stretched_corner(t, tile.x_low, tile.y_low, depth_high);
  const real3 f1 = stretched_corner(t, tile.x_high, tile.y_low, depth_high);
  const real3 f2 = stretched_corner(t, tile.x_high, tile.y_high, depth_high);
  const real3 f3 = stretched_corner(t, tile.x_low, tile.y_high, depth_high);
  const real near_edges = min(min(segment_distance_sq(n0, n1), segment_distance_sq(n1, n2)),
                              min(segment_distance_sq(n2, n3), segment_distance_sq(n3, n0)));
  const real far_edges = min(min(segment_distance_sq(f0, f1), segment_distance_sq(f1, f2)),
                             min(segment_distance_sq(f2, f3), segment_distance_sq(f3, f0)));
  const real side_edges = min(min(segment_distance_sq(n0, f0), segment_distance_sq(n1, f1)),
                              min(segment_distance_sq(n2, f2), segment_distance_sq(n3, f3)));
  const real caps = min(quad_interior_distance_sq(n0, n1, n2, n3), quad_interior_distance_sq(f0, f1, f2, f3));
  const real sides = min(min(quad_interior_distance_sq(n0, n1, f1, f0), quad_interior_distance_sq(n1, n2, f2, f1)),
                         min(quad_interior_distance_sq(n2, n3, f3, f2), quad_interior_distance_sq(n3, n0, f0, f3)));
  const real surface_sq = min(min(min(near_edges, far_edges), side_edges), min(caps, sides));
  const real3 v = t.centre;
  const mask inside = v.z >= depth_low && v.z <= depth_high && v.x >= tile.x_low * v.z && v.x <= tile.x_high * v.z &&
                      v.y >= tile.y_low * v.z && v.y <= tile.y_high * v.z;
  return select(inside, real(0.0f), surface_sq);
}

// Both halves, with the plane of the light's surface as in tile_test.h.
LUCIOLE_FN HalfMasks ellipsoid_touches_tile_exactly(TileTestEllipsoid t, Tile tile) {
  const real slope = largest_surface_slope(t.surface, tile);
  const real limit = 1.0002f;
  HalfMasks touches;
  touches.near_half = exact_distance_sq(t, tile, tile.near_low, tile.near_high) <= limit &&
                      above_surface(t.surface, slope, tile.near_low, tile.near_high) && tile.near_low <= tile.near_high;
  touches.far_half = exact_distance_sq(t, tile, tile.far_low, tile.far_high) <= limit &&
                     above_surface(t.surface, slope, tile.far_low, tile.far_high) && tile.far_low <= tile.far_high;
  return touches;
}

#endif
