// SPDX-License-Identifier: Apache-2.0
// The triangles that stand for a light's volume in the rivals of tiled culling: polyhedra round the unit sphere. The
// inverse of an ellipsoid's triangular factor (equations/tile_test.h) takes them to view space. Vertices are divided
// by the inradius, so that they contain the sphere; an inscribed polyhedron would lose lights.
#pragma once

namespace luciole {

// 20 triangles. Lanes past the last vertex and edge repeat the first.
struct alignas(64) IcosahedronProxy {
  static constexpr int kVertices = 12, kEdges = 30, kSlabs = 10, kTriangles = 2 * kSlabs;
  float vertex[3][16];
  float edge_from[3][32], edge_to[3][32];
  float slab_normal[3][kSlabs];  // opposite triangles lie in the planes normal . p = +-distance
  float distance;
};

// 80 triangles: an icosahedron with each triangle cut into four.
struct alignas(64) GeodesicProxy {
  static constexpr int kTriangles = 80;
  float corner[3][3][kTriangles];  // [corner][axis], anticlockwise from outside
  float normal[3][kTriangles];     // unit, outward
  float distance[kTriangles];
};

// Round a sphere of radius 1.001: what float loses on the way to the screen.
const IcosahedronProxy& circumscribed_icosahedron();
const GeodesicProxy& circumscribed_geodesic();

}  // namespace luciole
