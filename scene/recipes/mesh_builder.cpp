// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/mesh_builder.h"

#include <algorithm>
#include <cmath>

namespace luciole::workshop {
namespace {

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

Vec3 unit_or(Vec3 v, Vec3 fallback) {
  const float size = length(v);
  return size > 0 ? v / size : fallback;
}

// Adds a triangle unless two of its corners are one point.
void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto& p = mesh.positions;
  if (same(p[a], p[b]) || same(p[b], p[c]) || same(p[c], p[a])) return;
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

// Sums the vectors of lines that are the same place: the two seams of a wrapped grid.
void share_seams(const GridShape& shape, std::vector<Vec3>& sums) {
  const std::size_t stride = shape.columns + 1;
  if (shape.wrap_columns) {
    for (std::size_t j = 0; j <= shape.rows; ++j) {
      Vec3& first = sums[j * stride];
      Vec3& last = sums[j * stride + shape.columns];
      first = last = first + last;
    }
  }
  if (!shape.wrap_rows) return;
  for (std::size_t i = 0; i < stride; ++i) {
    Vec3& first = sums[i];
    Vec3& last = sums[shape.rows * stride + i];
    first = last = first + last;
  }
}

// A first or last row that is one point has one normal.
void share_pole(const GridShape& shape, std::size_t row, const std::vector<Vec3>& points, std::vector<Vec3>& sums) {
  const std::size_t begin = row * (shape.columns + 1), end = begin + shape.columns + 1;
  Vec3 total{0, 0, 0};
  for (std::size_t k = begin; k < end; ++k) {
    if (!same(points[k], points[begin])) return;
    total += sums[k];
  }
  std::fill(sums.begin() + static_cast<std::ptrdiff_t>(begin), sums.begin() + static_cast<std::ptrdiff_t>(end), total);
}

std::vector<Vec3> grid_normals(const GridShape& shape, const std::vector<Vec3>& points) {
  const std::size_t stride = shape.columns + 1;
  std::vector<Vec3> sums(points.size());
  for (std::size_t j = 0; j < shape.rows; ++j) {
    for (std::size_t i = 0; i < shape.columns; ++i) {
      const std::size_t a = j * stride + i, d = a + stride;
      const Vec3 twice_area = cross(points[d + 1] - points[a], points[d] - points[a + 1]);
      for (const std::size_t corner : {a, a + 1, d, d + 1}) sums[corner] += twice_area;
    }
  }
  share_seams(shape, sums);
  share_pole(shape, 0, points, sums);
  share_pole(shape, shape.rows, points, sums);
  for (Vec3& sum : sums) sum = unit_or(sum, {0, 1, 0});
  return sums;
}

}  // namespace

std::uint32_t Detail::segments(std::uint32_t full, std::uint32_t least) const {
  return std::max(least, static_cast<std::uint32_t>(std::lround(static_cast<float>(full) * std::sqrt(value))));
}

Mesh grid_from_points(const GridShape& shape, std::vector<Vec3> points) {
  Mesh mesh;
  mesh.normals = grid_normals(shape, points);
  mesh.positions = std::move(points);
  mesh.uv[0].reserve(mesh.positions.size());
  mesh.indices.reserve(std::size_t(6) * shape.columns * shape.rows);
  for (std::uint32_t j = 0; j <= shape.rows; ++j) {
    for (std::uint32_t i = 0; i <= shape.columns; ++i) {
      mesh.uv[0].push_back({shape.uv_size.x * static_cast<float>(i) / static_cast<float>(shape.columns),
                            shape.uv_size.y * static_cast<float>(j) / static_cast<float>(shape.rows)});
      if (i == shape.columns || j == shape.rows) continue;
      const std::uint32_t a = j * (shape.columns + 1) + i, d = a + shape.columns + 1;
      add_triangle(mesh, a, a + 1, d + 1);
      add_triangle(mesh, a, d + 1, d);
    }
  }
  return mesh;
}

Mesh grid_surface(const GridShape& shape, const std::function<Vec3(float u, float v)>& position) {
  std::vector<Vec3> points;
  points.reserve(std::size_t(shape.columns + 1) * (shape.rows + 1));
  for (std::uint32_t j = 0; j <= shape.rows; ++j) {
    const std::uint32_t row = shape.wrap_rows && j == shape.rows ? 0 : j;
    for (std::uint32_t i = 0; i <= shape.columns; ++i) {
      const std::uint32_t column = shape.wrap_columns && i == shape.columns ? 0 : i;
      points.push_back(position(static_cast<float>(column) / static_cast<float>(shape.columns),
                                static_cast<float>(row) / static_cast<float>(shape.rows)));
    }
  }
  return grid_from_points(shape, std::move(points));
}

void set_uv(Mesh& mesh, const std::vector<float>& u, const std::vector<float>& v) {
  for (std::size_t j = 0; j < v.size(); ++j) {
    for (std::size_t i = 0; i < u.size(); ++i) mesh.uv[0][j * u.size() + i] = {u[i], v[j]};
  }
}

Mesh rectangle(Vec3 corner, Vec3 side_u, Vec3 side_v, std::uint32_t columns, std::uint32_t rows) {
  return grid_surface({columns, rows, false, false, {length(side_u), length(side_v)}},
                      [=](float u, float v) { return corner + side_u * u + side_v * v; });
}

Mesh fan(const std::vector<Vec3>& loop, Vec3 normal) {
  Mesh mesh;
  Vec3 centre{0, 0, 0};
  for (const Vec3 p : loop) centre += p / static_cast<float>(loop.size());
  mesh.positions = loop;
  mesh.positions.push_back(centre);
  mesh.normals.assign(mesh.positions.size(), normal);
  mesh.uv[0].assign(mesh.positions.size(), Vec2{0, 0});
  const auto count = static_cast<std::uint32_t>(loop.size());
  for (std::uint32_t i = 0; i < count; ++i) add_triangle(mesh, count, i, (i + 1) % count);
  return mesh;
}

void append(Mesh& whole, const Mesh& part, const Affine& world_from_part) {
  const auto base = static_cast<std::uint32_t>(whole.positions.size());
  const float side = world_from_part.determinant() < 0 ? -1.0f : 1.0f;
  for (const Vec3 p : part.positions) whole.positions.push_back(world_from_part.point(p));
  for (const Vec3 n : part.normals) whole.normals.push_back(unit_or(world_from_part.normal(n) * side, {0, 1, 0}));
  whole.uv[0].insert(whole.uv[0].end(), part.uv[0].begin(), part.uv[0].end());
  for (std::size_t k = 0; k + 2 < part.indices.size(); k += 3) {
    const std::uint32_t a = part.indices[k], b = part.indices[k + 1], c = part.indices[k + 2];
    if (side > 0) {
      whole.indices.insert(whole.indices.end(), {base + a, base + b, base + c});
    } else {
      whole.indices.insert(whole.indices.end(), {base + a, base + c, base + b});
    }
  }
}

Mesh placed(const Mesh& mesh, const Affine& world_from_mesh) {
  Mesh result;
  append(result, mesh, world_from_mesh);
  return result;
}

Mesh turned_inside_out(Mesh mesh) {
  for (Vec3& n : mesh.normals) n = -n;
  for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) std::swap(mesh.indices[k + 1], mesh.indices[k + 2]);
  return mesh;
}

void scale_uv(Mesh& mesh, float tile) {
  for (Vec2& uv : mesh.uv[0]) uv = uv * (1 / tile);
}

void add_tangents(Mesh& mesh) {
  std::vector<Vec3> along_u(mesh.positions.size()), along_v(mesh.positions.size());
  for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
    const std::uint32_t a = mesh.indices[k], b = mesh.indices[k + 1], c = mesh.indices[k + 2];
    const Vec3 p = mesh.positions[b] - mesh.positions[a], q = mesh.positions[c] - mesh.positions[a];
    const Vec2 s = mesh.uv[0][b] - mesh.uv[0][a], t = mesh.uv[0][c] - mesh.uv[0][a];
    const float area = s.x * t.y - s.y * t.x;
    if (area == 0) continue;
    for (const std::uint32_t corner : {a, b, c}) {
      along_u[corner] += (p * t.y - q * s.y) / area;
      along_v[corner] += (q * s.x - p * t.x) / area;
    }
  }
  mesh.tangents.resize(mesh.positions.size());
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const Vec3 n = mesh.normals[k];
    const Vec3 any = unit_or(cross(n, std::abs(n.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 1, 0}), {1, 0, 0});
    const Vec3 t = unit_or(along_u[k] - n * dot(n, along_u[k]), any);
    mesh.tangents[k] = {t.x, t.y, t.z, dot(cross(n, t), along_v[k]) > 0 ? -1.0f : 1.0f};
  }
}

}  // namespace luciole::workshop
