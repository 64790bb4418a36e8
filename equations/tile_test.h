// SPDX-License-Identifier: Apache-2.0
// Does the bound of a light touch what a tile of the screen sees? Two halves of the tile's depth are answered at once.
// Tile space: origin at the eye, x to the right, y upwards, z forward (depth); a tile is a range of slopes x/z and y/z.
//
// A light is prepared once per frame (TileTestEllipsoid, TileTestSphere); then each tile costs about 60 operations. In
// wide code lanes are lights, and the tile is the same in all lanes. No test ever loses a pair that touches, also in
// float, and bounds of any size pass.
#ifndef LUCIOLE_TILE_TEST_H
#define LUCIOLE_TILE_TEST_H
#include "equations/bounding_sphere.h"

struct ViewFrame {
  real3 eye;    // [m] world
  real3 right;  // orthonormal
  real3 up;
  real3 forward;
};

// Part of the frustum of one tile: depths of its nearer and its farther surfaces (Modified HalfZ).   [TH17] sect. 5.1
struct Tile {
  real x_low, x_high;        // slopes x/z of the left and right side
  real y_low, y_high;        // slopes y/z
  real near_low, near_high;  // depth range of the nearer half   [m]  > 0; an empty half has low > high
  real far_low, far_high;    // depth range of the farther half  [m]
};

struct HalfMasks {
  mask near_half;
  mask far_half;
};

LUCIOLE_FN real3 view_from_world_direction(ViewFrame view, real3 v) {
  return real3(dot(v, view.right), dot(v, view.up), dot(v, view.forward));
}
LUCIOLE_FN real3 view_from_world(ViewFrame view, real3 p) { return view_from_world_direction(view, p - view.eye); }

// Triangular factor M of an ellipsoid's quadratic form, M^T M = Q: it maps the ellipsoid to a unit sphere, keeps depth
// planes perpendicular to z, and y free of x.                          [TH17] Eqs. 16-17, x-first
struct TriangularFactor {
  real m00, m01, m02;  // [1/m]
  real m11, m12;
  real m22;
};

// Half space above a light's surface, in tile space.
struct SurfacePlane {
  real3 normal;  // unit
  real offset;   // n . q less a margin for float  [m]
};

// paper: B S by two matrix products; they are this factor, built here from the columns of T = diag(1/r) R^T without
// squaring the condition number (a Cholesky factor of Q would lose hits in float).
//   u, v, w   unit axes in tile space     r_u, r_v, r_w  semi-axes [m]
LUCIOLE_FN TriangularFactor triangular_factor(real3 u, real3 v, real3 w, real3 inverse_radii) {
  const real3 bx = real3(u.x, v.x, w.x) * inverse_radii;
  const real3 by = real3(u.y, v.y, w.y) * inverse_radii;
  const real3 bq = real3(u.z, v.z, w.z) * inverse_radii;
  const real3 bz = cross(bx, by);
  const real inverse_x = inverse_sqrt(dot(bx, bx));
  const real inverse_z = inverse_sqrt(dot(bz, bz));
  TriangularFactor m;
  m.m00 = dot(bx, bx) * inverse_x;
  m.m01 = dot(bx, by) * inverse_x;
  m.m02 = dot(bx, bq) * inverse_x;
  m.m11 = dot(bz, bz) * inverse_z * inverse_x;
  m.m12 = dot(cross(bz, bx), bq) * (inverse_z * inverse_x);
  m.m22 = inverse_radii.x * inverse_radii.y * inverse_radii.z * inverse_z;
  return m;
}

struct TileTestEllipsoid {
  TriangularFactor factor;
  real3 stretched;               // M v: centre of the unit sphere
  real3 centre;                  // v, tile space                        [m]
  real sxx, sxz, syy, syz, szz;  // Sigma = Q^-1, with tolerance  [m^2]
  SurfacePlane surface;
};

struct TileTestSphere {
  real3 centre;    // tile space                [m]
  real radius_sq;  // with tolerance            [m^2]
  SurfacePlane surface;
};

// No point below the light's surface is lit, whatever the bound says.
//   position, normal  of the light in world space. A zero normal switches the plane off.
LUCIOLE_FN SurfacePlane surface_plane(ViewFrame view, real3 position, real3 normal) {
  const real3 q = view_from_world(view, position);
  SurfacePlane s;
  s.normal = view_from_world_direction(view, normal);
  s.offset = dot(s.normal, q) - 1e-5f * length(q);
  return s;
}

// Prepares an ellipsoid. Semi-axes grow by 1e-4, and by 4e-6 of the distance to the eye: what float loses.
LUCIOLE_FN TileTestEllipsoid prepare_ellipsoid(ViewFrame view, BoundingEllipsoid e, SurfacePlane surface) {
  const real3 centre = view_from_world(view, e.centre);
  const real3 u = view_from_world_direction(view, e.axis_u);
  const real3 w = view_from_world_direction(view, e.axis_w);
  const real3 v = cross(w, u);
  const real guard = 4e-6f * length(centre);
  const real3 radii = real3(e.r_u, e.r_v, e.r_w) * 1.0001f + real3(guard, guard, guard);
  const real3 inverse_radii = real3(1.0f / radii.x, 1.0f / radii.y, 1.0f / radii.z);
  TileTestEllipsoid t;
  const TriangularFactor m = triangular_factor(u, v, w, inverse_radii);
  t.factor = m;
  t.centre = centre;
  t.stretched = real3(m.m00 * centre.x + m.m01 * centre.y + m.m02 * centre.z, m.m11 * centre.y + m.m12 * centre.z,
                      m.m22 * centre.z);
  const real3 su = u * radii.x;
  const real3 sv = v * radii.y;
  const real3 sw = w * radii.z;
  // Side planes in float: a part of the support, and what a long axis loses when a thin one is seen edge on.
  const real tolerance = 1.001f;
  const real edge_on = 2e-6f * (dot(su, su) + dot(sv, sv) + dot(sw, sw));
  t.sxx = (su.x * su.x + sv.x * sv.x + sw.x * sw.x) * tolerance + edge_on;
  t.sxz = (su.x * su.z + sv.x * sv.z + sw.x * sw.z) * tolerance;
  t.syy = (su.y * su.y + sv.y * sv.y + sw.y * sw.y) * tolerance + edge_on;
  t.syz = (su.y * su.z + sv.y * sv.z + sw.y * sw.z) * tolerance;
  t.szz = (su.z * su.z + sv.z * sv.z + sw.z * sw.z) * tolerance + edge_on;
  t.surface = surface;
  return t;
}

LUCIOLE_FN TileTestSphere prepare_sphere(ViewFrame view, BoundingSphere sphere, SurfacePlane surface) {
  TileTestSphere t;
  t.centre = view_from_world(view, sphere.centre);
  const real radius = sphere.radius * 1.0001f + 4e-6f * length(t.centre);
  t.radius_sq = radius * radius;
  t.surface = surface;
  return t;
}

// Side planes of a tile with unit normals, and its depths: for the sphere that goes ahead of the ellipsoid.
struct SidePlanes {
  real left_x, left_z, right_x, right_z, low_y, low_z, high_y, high_z;
  real depth_low, depth_high;  // [m]
};

//   tile  with a nearer half that is not empty
LUCIOLE_FN SidePlanes side_planes(Tile tile) {
  const real left = inverse_sqrt(1.0f + tile.x_low * tile.x_low);
  const real right = inverse_sqrt(1.0f + tile.x_high * tile.x_high);
  const real low = inverse_sqrt(1.0f + tile.y_low * tile.y_low);
  const real high = inverse_sqrt(1.0f + tile.y_high * tile.y_high);
  SidePlanes p;
  p.left_x = left;
  p.left_z = tile.x_low * left;
  p.right_x = right;
  p.right_z = tile.x_high * right;
  p.low_y = low;
  p.low_z = tile.y_low * low;
  p.high_y = high;
  p.high_z = tile.y_high * high;
  p.depth_low = tile.near_low;
  p.depth_high = select(tile.far_low <= tile.far_high, tile.far_high, tile.near_high);
  return p;
}

// Conservative and cheap: 12 operations reject most of the lights, whatever their kind of bound.
//   radius  with tolerance, as prepare_ellipsoid grows semi-axes  [m]
LUCIOLE_FN mask sphere_may_touch(SidePlanes p, real3 centre, real radius) {
  const real gap_x = max(p.left_z * centre.z - p.left_x * centre.x, p.right_x * centre.x - p.right_z * centre.z);
  const real gap_y = max(p.low_z * centre.z - p.low_y * centre.y, p.high_y * centre.y - p.high_z * centre.z);
  const real gap_z = max(p.depth_low - centre.z, centre.z - p.depth_high);
  return max(max(gap_x, gap_y), gap_z) <= radius;
}

// Does the light's surface see any of a depth range of the tile?
//   slope  largest n.d over the tile's rays d = (x, y, 1)
LUCIOLE_FN mask above_surface(SurfacePlane surface, real slope, real depth_low, real depth_high) {
  return max(slope * depth_low, slope * depth_high) >= surface.offset;
}
LUCIOLE_FN real largest_surface_slope(SurfacePlane surface, Tile tile) {
  return max(surface.normal.x * tile.x_low, surface.normal.x * tile.x_high) +
         max(surface.normal.y * tile.y_low, surface.normal.y * tile.y_high) + surface.normal.z;
}

// Least and largest stretched x and y per unit of depth, over the tile's rays.
struct StretchedSlopes {
  real x_low, x_high;
  real y_low, y_high;
};

LUCIOLE_FN StretchedSlopes stretched_slopes(TriangularFactor m, Tile tile) {
  StretchedSlopes s;
  s.y_low = m.m11 * tile.y_low + m.m12;
  s.y_high = m.m11 * tile.y_high + m.m12;
  s.x_low = m.m00 * tile.x_low + min(m.m01 * tile.y_low, m.m01 * tile.y_high) + m.m02;
  s.x_high = m.m00 * tile.x_high + max(m.m01 * tile.y_low, m.m01 * tile.y_high) + m.m02;
  return s;
}

// Squared distance, in the stretched space, from the unit sphere's centre to the box around a part of the frustum.
// The box is that of the 8 corners, exactly: x and y are extremal at extremal slopes, and all is linear in depth.
//   z_scale  m22
LUCIOLE_FN real stretched_distance_sq(real3 centre, real z_scale, StretchedSlopes s, real depth_low, real depth_high) {
  const real z_gap = max(z_scale * depth_low - centre.z, centre.z - z_scale * depth_high);
  const real y_gap = max(min(s.y_low * depth_low, s.y_low * depth_high) - centre.y,
                         centre.y - max(s.y_high * depth_low, s.y_high * depth_high));
  const real x_gap = max(min(s.x_low * depth_low, s.x_low * depth_high) - centre.x,
                         centre.x - max(s.x_high * depth_low, s.x_high * depth_high));
  const real ex = max(x_gap, real(0.0f));
  const real ey = max(y_gap, real(0.0f));
  const real ez = max(z_gap, real(0.0f));
  return ex * ex + ey * ey + ez * ez;
}

// Is the ellipsoid wholly beyond a side plane of the tile?  Its support along the plane's normal (not normalised).
//   gap         normal . centre, negative outside
//   support_sq  normal^T Sigma normal
LUCIOLE_FN mask beyond_side(real gap, real support_sq) { return gap < 0.0f && gap * gap > support_sq; }

LUCIOLE_FN mask within_sides(TileTestEllipsoid t, Tile tile) {
  const real3 v = t.centre;
  const mask left = beyond_side(v.x - tile.x_low * v.z, t.sxx - tile.x_low * (2.0f * t.sxz - tile.x_low * t.szz));
  const mask right = beyond_side(tile.x_high * v.z - v.x, t.sxx - tile.x_high * (2.0f * t.sxz - tile.x_high * t.szz));
  const mask below = beyond_side(v.y - tile.y_low * v.z, t.syy - tile.y_low * (2.0f * t.syz - tile.y_low * t.szz));
  const mask above = beyond_side(tile.y_high * v.z - v.y, t.syy - tile.y_high * (2.0f * t.syz - tile.y_high * t.szz));
  return !(left || right || below || above);
}

// Our test of an ellipsoid: box in the stretched space, side planes, and the plane of the light's surface.
LUCIOLE_FN HalfMasks ellipsoid_touches_tile(TileTestEllipsoid t, Tile tile) {
  const StretchedSlopes slopes = stretched_slopes(t.factor, tile);
  const real scale = t.factor.m22;
  const real near_sq = stretched_distance_sq(t.stretched, scale, slopes, tile.near_low, tile.near_high);
  const real far_sq = stretched_distance_sq(t.stretched, scale, slopes, tile.far_low, tile.far_high);
  const real slope = largest_surface_slope(t.surface, tile);
  const mask sides = within_sides(t, tile);
  const real limit = 1.0002f;
  HalfMasks touches;
  touches.near_half = sides && near_sq <= limit && above_surface(t.surface, slope, tile.near_low, tile.near_high);
  touches.far_half = sides && far_sq <= limit && above_surface(t.surface, slope, tile.far_low, tile.far_high);
  return touches;
}

// The same for a sphere: nothing to stretch.
LUCIOLE_FN HalfMasks sphere_touches_tile(TileTestSphere t, Tile tile) {
  StretchedSlopes slopes;
  slopes.x_low = tile.x_low;
  slopes.x_high = tile.x_high;
  slopes.y_low = tile.y_low;
  slopes.y_high = tile.y_high;
  const real near_sq = stretched_distance_sq(t.centre, 1.0f, slopes, tile.near_low, tile.near_high);
  const real far_sq = stretched_distance_sq(t.centre, 1.0f, slopes, tile.far_low, tile.far_high);
  const real3 v = t.centre;
  const real r_sq = t.radius_sq * 1.001f;
  const mask outside = beyond_side(v.x - tile.x_low * v.z, r_sq * (1.0f + tile.x_low * tile.x_low)) ||
                       beyond_side(tile.x_high * v.z - v.x, r_sq * (1.0f + tile.x_high * tile.x_high)) ||
                       beyond_side(v.y - tile.y_low * v.z, r_sq * (1.0f + tile.y_low * tile.y_low)) ||
                       beyond_side(tile.y_high * v.z - v.y, r_sq * (1.0f + tile.y_high * tile.y_high));
  const real slope = largest_surface_slope(t.surface, tile);
  const real limit = t.radius_sq * 1.0002f;
  HalfMasks touches;
  touches.near_half = !outside && near_sq <= limit && above_surface(t.surface, slope, tile.near_low, tile.near_high);
  touches.far_half = !outside && far_sq <= limit && above_surface(t.surface, slope, tile.far_low, tile.far_high);
  return touches;
}

#endif
