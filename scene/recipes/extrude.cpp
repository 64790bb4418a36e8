// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "scene/recipes/placement.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop {
namespace {

// Twice the signed area of a triangle. In double: the corners of fine curves are nearly on a line.
double turn(Vec2 a, Vec2 b, Vec2 c) {
  const double ux = static_cast<double>(b.x) - a.x, uy = static_cast<double>(b.y) - a.y;
  const double vx = static_cast<double>(c.x) - a.x, vy = static_cast<double>(c.y) - a.y;
  return ux * vy - uy * vx;
}

// An ear: a convex corner whose triangle holds no other point of what is left.
bool is_ear(const std::vector<Vec2>& p, const std::vector<std::uint32_t>& left, std::size_t k) {
  const std::size_t n = left.size();
  const std::uint32_t a = left[(k + n - 1) % n], b = left[k], c = left[(k + 1) % n];
  if (turn(p[a], p[b], p[c]) <= 0) return false;
  return std::none_of(left.begin(), left.end(), [&](std::uint32_t q) {
    return q != a && q != b && q != c && turn(p[a], p[b], p[q]) >= 0 && turn(p[b], p[c], p[q]) >= 0 &&
           turn(p[c], p[a], p[q]) >= 0;
  });
}

// Where rounding leaves no ear: the corner that sticks out most.
std::size_t sharpest(const std::vector<Vec2>& p, const std::vector<std::uint32_t>& left) {
  const std::size_t n = left.size();
  std::size_t best = 0;
  double most = -1;
  for (std::size_t k = 0; k < n; ++k) {
    const double area = turn(p[left[(k + n - 1) % n]], p[left[k]], p[left[(k + 1) % n]]);
    if (area > most) most = area, best = k;
  }
  return best;
}

// Triangles of a simple counter-clockwise polygon, by cutting ears.
std::vector<std::uint32_t> triangulate(const std::vector<Vec2>& polygon) {
  std::vector<std::uint32_t> left(polygon.size()), triangles;
  std::iota(left.begin(), left.end(), 0u);
  while (left.size() > 2) {
    std::size_t k = 0;
    const std::size_t n = left.size();
    while (k < n && !is_ear(polygon, left, k)) ++k;
    if (k == n) k = sharpest(polygon, left);
    triangles.insert(triangles.end(), {left[(k + n - 1) % n], left[k], left[(k + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return triangles;
}

// The flat face at height z, front along +z.
Mesh face(const std::vector<Vec2>& outline, const std::vector<Vec2>& hole, float z) {
  Mesh mesh;
  for (const auto* loop : {&outline, &hole}) {
    for (const Vec2 p : *loop) {
      mesh.positions.push_back({p.x, p.y, z});
      mesh.uv[0].push_back({p.x, -p.y});
    }
  }
  mesh.normals.assign(mesh.positions.size(), Vec3{0, 0, 1});
  if (hole.empty()) {
    mesh.indices = triangulate(outline);
    return mesh;
  }
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.indices.insert(mesh.indices.end(), {i, next, n + next, i, n + next, n + i});
  }
  return mesh;
}

// The rim round a loop, from the back face over two rounded edges to the front face.
Mesh rim(const std::vector<Vec2>& loop, const Extrusion& shape) {
  const auto columns = static_cast<std::uint32_t>(loop.size());
  constexpr int kArc = 3;
  std::vector<Vec3> points;
  for (int j = 0; j <= 2 * kArc + 1; ++j) {
    const bool front = j > kArc;
    const float angle = radians(90) * static_cast<float>(front ? j - kArc - 1 : kArc - j) / kArc;
    const float height = shape.depth / 2 - shape.bevel * (1 - std::sin(angle));
    const std::vector<Vec2> line = moved_outwards(loop, shape.bevel * (std::cos(angle) - 1));
    for (std::size_t i = 0; i <= columns; ++i) {
      const Vec2 p = line[i % columns];
      points.push_back({p.x, p.y, front ? height : -height});
    }
  }
  constexpr std::uint32_t kRows = 2 * kArc + 1;
  Mesh mesh = grid_from_points({columns, kRows, true, false, {1, 1}}, std::move(points));
  for (std::uint32_t i = 0; i <= columns; ++i) {  // the faces' normals where they meet the rim
    mesh.normals[i] = {0, 0, -1};
    mesh.normals[kRows * (columns + 1) + i] = {0, 0, 1};
  }
  return mesh;
}

}  // namespace

Mesh extrude(const Extrusion& shape) {
  std::vector<Vec2> reversed_hole(shape.hole.rbegin(), shape.hole.rend());
  Mesh mesh = rim(shape.outline, shape);
  std::vector<Vec2> inner_hole;
  if (!shape.hole.empty()) {
    append(mesh, rim(reversed_hole, shape));
    inner_hole = moved_outwards(reversed_hole, -shape.bevel);
    std::reverse(inner_hole.begin(), inner_hole.end());
  }
  const Mesh flat = face(moved_outwards(shape.outline, -shape.bevel), inner_hole, shape.depth / 2);
  append(mesh, flat);
  append(mesh, flat, scale({1, 1, -1}));
  return mesh;
}

}  // namespace luciole::workshop
