// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_culling/sphere_proxy.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/vector.h"

namespace luciole {
namespace {

constexpr float kInradius = 1.001f;
constexpr float kGolden = 1.61803398875f;

using Triangle = std::array<Vec3, 3>;

std::vector<Vec3> icosahedron_vertices() {
  std::vector<Vec3> vertices;
  for (const float a : {-1.0f, 1.0f}) {
    for (const float b : {-kGolden, kGolden}) {
      for (const Vec3& v : {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)}) vertices.push_back(normalize(v));
    }
  }
  return vertices;
}

// Neighbours subtend 63 degrees, others 117 or 180.
bool neighbours(Vec3 a, Vec3 b) { return dot(a, b) > 0.0f && dot(a, b) < 0.9f; }

Vec3 unit_normal(const Triangle& t) { return normalize(cross(t[1] - t[0], t[2] - t[0])); }
float plane_distance(const Triangle& t) { return dot(unit_normal(t), t[0]); }

Triangle outward(const Triangle& t) { return plane_distance(t) > 0.0f ? t : Triangle{t[0], t[2], t[1]}; }

std::vector<Triangle> icosahedron_triangles() {
  const std::vector<Vec3> v = icosahedron_vertices();
  std::vector<Triangle> triangles;
  for (std::size_t a = 0; a < v.size(); ++a) {
    for (std::size_t b = a + 1; b < v.size(); ++b) {
      for (std::size_t c = b + 1; c < v.size(); ++c) {
        if (neighbours(v[a], v[b]) && neighbours(v[b], v[c]) && neighbours(v[c], v[a])) {
          triangles.push_back(outward({v[a], v[b], v[c]}));
        }
      }
    }
  }
  return triangles;
}

std::vector<Triangle> cut_into_four(const std::vector<Triangle>& triangles) {
  std::vector<Triangle> cut;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 ab = normalize(a + b), bc = normalize(b + c), ca = normalize(c + a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) cut.push_back(t);
  }
  return cut;
}

// What brings the nearest plane to the inradius.
float circumscribing_scale(const std::vector<Triangle>& triangles) {
  float nearest = 1.0f;
  for (const Triangle& t : triangles) nearest = std::min(nearest, plane_distance(t));
  return kInradius / nearest;
}

template <std::size_t count>
void put(float (&to)[3][count], std::size_t at, Vec3 v) {
  to[0][at] = v.x, to[1][at] = v.y, to[2][at] = v.z;
}

IcosahedronProxy make_icosahedron() {
  const std::vector<Vec3> vertices = icosahedron_vertices();
  const std::vector<Triangle> triangles = icosahedron_triangles();
  const float scale = circumscribing_scale(triangles);
  std::vector<std::array<Vec3, 2>> edges;
  for (std::size_t a = 0; a < vertices.size(); ++a) {
    for (std::size_t b = a + 1; b < vertices.size(); ++b) {
      if (neighbours(vertices[a], vertices[b])) edges.push_back({vertices[a] * scale, vertices[b] * scale});
    }
  }
  IcosahedronProxy proxy{};
  for (std::size_t i = 0; i < 16; ++i) put(proxy.vertex, i, vertices[i < vertices.size() ? i : 0] * scale);
  for (std::size_t i = 0; i < 32; ++i) {
    const std::array<Vec3, 2>& edge = edges[i < edges.size() ? i : 0];
    put(proxy.edge_from, i, edge[0]), put(proxy.edge_to, i, edge[1]);
  }
  std::size_t slab = 0;
  for (const Triangle& t : triangles) {
    const Vec3 n = unit_normal(t);
    const bool first_of_pair = n.x > 1e-3f || (n.x > -1e-3f && (n.y > 1e-3f || (n.y > -1e-3f && n.z > 0.0f)));
    if (first_of_pair) put(proxy.slab_normal, slab++, n);
  }
  proxy.distance = kInradius;
  return proxy;
}

GeodesicProxy make_geodesic() {
  const std::vector<Triangle> triangles = cut_into_four(icosahedron_triangles());
  const float scale = circumscribing_scale(triangles);
  GeodesicProxy proxy{};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) put(proxy.corner[k], i, triangles[i][k] * scale);
    put(proxy.normal, i, unit_normal(triangles[i]));
    proxy.distance[i] = plane_distance(triangles[i]) * scale;
  }
  return proxy;
}

}  // namespace

const IcosahedronProxy& circumscribed_icosahedron() {
  static const IcosahedronProxy proxy = make_icosahedron();
  return proxy;
}

const GeodesicProxy& circumscribed_geodesic() {
  static const GeodesicProxy proxy = make_geodesic();
  return proxy;
}

}  // namespace luciole
