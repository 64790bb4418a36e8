// SPDX-License-Identifier: Apache-2.0
// The triangles that stand for a light's volume in the rivals of tiled culling: polyhedra round the unit sphere. The
// inverse of an ellipsoid's triangular factor (equations/tile_test.h) takes them to view space. Vertices are divided
// by the inradius, so that they contain the sphere; an inscribed polyhedron would lose lights.
// Shaders read the same records.
#ifndef LUCIOLE_SPHERE_PROXY_H
#define LUCIOLE_SPHERE_PROXY_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// 20 triangles. Lanes past the last vertex and edge repeat the first.
struct LUCIOLE_ALIGNED(64) IcosahedronProxy {
#if defined(__cplusplus)
  static constexpr int kVertices = 12, kEdges = 30, kSlabs = 10, kTriangles = 2 * kSlabs;
#endif
  float vertex[3][16];
  float edge_from[3][32], edge_to[3][32];
  float slab_normal[3][10];  // opposite triangles lie in the planes normal . p = +-distance
  float distance;
  float unused;
};

// 80 triangles: an icosahedron with each triangle cut into four.
struct LUCIOLE_ALIGNED(64) GeodesicProxy {
#if defined(__cplusplus)
  static constexpr int kTriangles = 80;
#endif
  float corner[3][3][80];  // [corner][axis], anticlockwise from outside
  float normal[3][80];     // unit, outward
  float distance[80];
};

#if defined(__cplusplus)
static_assert(sizeof(IcosahedronProxy) == 1088 && offsetof(IcosahedronProxy, unused) == 1084);
static_assert(sizeof(GeodesicProxy) == 4160);

// Round a sphere of radius 1.001: what float loses on the way to the screen.
const IcosahedronProxy& circumscribed_icosahedron();
const GeodesicProxy& circumscribed_geodesic();
#endif

LUCIOLE_RECORDS_END

#endif
