// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "scene/recipes/mesh_builder.h"

namespace luciole::workshop {
namespace {

constexpr std::array<Vec3 (*)(float), 3> kAxis = {[](float s) {
                                                    return Vec3{s, 0, 0};
                                                  },
                                                  [](float s) {
                                                    return Vec3{0, s, 0};
                                                  },
                                                  [](float s) {
                                                    return Vec3{0, 0, s};
                                                  }};

// The box has 8 corners, each with three vertices, one per face that meets there: vertex(corner, axis). Bit k of
// `corner` says on which side of axis k it lies. Its normal is that of the face: bevels blend between them.
std::uint32_t vertex(std::uint32_t corner, std::uint32_t axis) { return corner * 3 + axis; }

// A triangle whose front is on the side of `outward`.
void add_facing(Mesh& mesh, std::array<std::uint32_t, 3> t, Vec3 outward) {
  const auto& p = mesh.positions;
  if (dot(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), outward) < 0) std::swap(t[1], t[2]);
  mesh.indices.insert(mesh.indices.end(), t.begin(), t.end());
}

Vec3 side_of(std::uint32_t corner, std::uint32_t axis) { return kAxis[axis]((corner >> axis) & 1u ? 1.0f : -1.0f); }

void add_vertices(Mesh& mesh, Vec3 half, float bevel) {
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const Vec3 sign = side_of(corner, 0) + side_of(corner, 1) + side_of(corner, 2);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const Vec3 normal = side_of(corner, axis);
      const Vec3 p = sign * (half - Vec3{bevel, bevel, bevel}) + normal * bevel;
      mesh.positions.push_back(p);
      mesh.normals.push_back(normal);
      mesh.uv[0].push_back(axis == 1 ? Vec2{p.x, p.z} : (axis == 0 ? Vec2{p.z, -p.y} : Vec2{p.x, -p.y}));
    }
  }
}

}  // namespace

Mesh rounded_box(Vec3 size, float bevel) {
  const Vec3 half = size * 0.5f;
  bevel = std::min(bevel, 0.49f * std::min({size.x, size.y, size.z}));
  Mesh mesh;
  add_vertices(mesh, half, bevel);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t u = 1u << ((axis + 1) % 3), v = 1u << ((axis + 2) % 3);
    for (const std::uint32_t base : {0u, 1u << axis}) {  // the two faces across this axis
      const Vec3 outward = side_of(base, axis);
      add_facing(mesh, {vertex(base, axis), vertex(base | u, axis), vertex(base | u | v, axis)}, outward);
      add_facing(mesh, {vertex(base, axis), vertex(base | u | v, axis), vertex(base | v, axis)}, outward);
    }
    for (const std::uint32_t base : {0u, u, v, u | v}) {  // the four edges along this axis
      const std::uint32_t far_end = base | (1u << axis), one = (axis + 1) % 3, two = (axis + 2) % 3;
      const Vec3 outward = side_of(base, one) + side_of(base, two);
      add_facing(mesh, {vertex(base, one), vertex(base, two), vertex(far_end, two)}, outward);
      add_facing(mesh, {vertex(base, one), vertex(far_end, two), vertex(far_end, one)}, outward);
    }
  }
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const Vec3 outward = side_of(corner, 0) + side_of(corner, 1) + side_of(corner, 2);
    add_facing(mesh, {vertex(corner, 0), vertex(corner, 1), vertex(corner, 2)}, outward);
  }
  return mesh;
}

}  // namespace luciole::workshop
