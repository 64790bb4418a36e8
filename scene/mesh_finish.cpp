// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh_finish.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/file_fault.h"

namespace luciole {
namespace {

// Squares of larger coordinates are no longer floats.
constexpr float kLargestCoordinate = 1e15f;  // [m]

template <class T>
void gather(std::vector<T>& values, const std::vector<std::uint32_t>& source) {
  if (values.empty()) return;
  std::vector<T> result(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) result[i] = values[source[i]];
  values = std::move(result);
}

// Vertex i of the new mesh is vertex source[i] of the old one.
void rearrange_vertices(Mesh& mesh, const std::vector<std::uint32_t>& source) {
  gather(mesh.positions, source);
  gather(mesh.normals, source);
  gather(mesh.tangents, source);
  gather(mesh.uv[0], source);
  gather(mesh.uv[1], source);
  gather(mesh.colours, source);
}

// Zero for what has no direction.
Vec3 unit_or_zero(Vec3 v) {
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) return {0, 0, 0};
  const Vec3 scaled = v / largest;  // neither overflow nor underflow in the square
  return scaled / length(scaled);
}

bool is_zero(Vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }

Vec3 triangle_normal(const Mesh& mesh, std::size_t first_corner) {
  const Vec3 a = mesh.positions[mesh.indices[first_corner]];
  const Vec3 b = mesh.positions[mesh.indices[first_corner + 1]];
  const Vec3 c = mesh.positions[mesh.indices[first_corner + 2]];
  return unit_or_zero(cross(unit_or_zero(b - a), unit_or_zero(c - a)));
}

}  // namespace

void drop_unused_vertices(Mesh& mesh) {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> target(mesh.positions.size(), kUnused);
  std::vector<std::uint32_t> source;
  for (const std::uint32_t index : mesh.indices) {
    if (target[index] != kUnused) continue;
    target[index] = 0;  // used; numbered below, in the file's order
  }
  for (std::uint32_t vertex = 0; vertex < target.size(); ++vertex) {
    if (target[vertex] == kUnused) continue;
    target[vertex] = static_cast<std::uint32_t>(source.size());
    source.push_back(vertex);
  }
  if (source.size() == mesh.positions.size()) return;
  rearrange_vertices(mesh, source);
  for (std::uint32_t& index : mesh.indices) index = target[index];
}

void normalise_normals(Mesh& mesh) {
  if (mesh.normals.empty()) return;
  bool some_missing = false;
  for (Vec3& normal : mesh.normals) {
    normal = unit_or_zero(normal);
    some_missing = some_missing || is_zero(normal);
  }
  if (!some_missing) return;
  for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
    Vec3& normal = mesh.normals[mesh.indices[corner]];
    if (is_zero(normal)) normal = triangle_normal(mesh, corner / 3 * 3);
  }
  for (Vec3& normal : mesh.normals) {
    if (is_zero(normal)) normal = {0, 1, 0};  // only triangles without area meet here: any direction will do
  }
}

void separate_triangles(Mesh& mesh) {
  rearrange_vertices(mesh, mesh.indices);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
}

void transform_mesh(Mesh& mesh, const Affine& world_from_mesh, const std::string& object) {
  const float determinant = world_from_mesh.determinant();
  const float side = determinant < 0 ? -1.0f : 1.0f;
  for (Vec3& position : mesh.positions) {
    position = world_from_mesh.point(position);
    const float largest = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    if (!(largest <= kLargestCoordinate)) {
      fail("VALUE_NOT_IN_RANGE", object, "a vertex lies further than 1e15 m from the origin");
    }
  }
  if (side < 0) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  for (Vec3& normal : mesh.normals) normal = world_from_mesh.normal(normal) * side;
  normalise_normals(mesh);
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    Vec4& tangent = mesh.tangents[i];
    const Vec3 along = world_from_mesh.vector({tangent.x, tangent.y, tangent.z});
    // Flat meshes have no normals; their tangents lie in the triangles already.
    const Vec3 normal = mesh.normals.empty() ? Vec3(0, 0, 0) : mesh.normals[i];
    Vec3 unit = unit_or_zero(along - normal * dot(along, normal));
    if (is_zero(unit)) unit = unit_or_zero(cross(normal, Vec3(0.36f, 0.48f, 0.8f)));  // no direction is right
    if (is_zero(unit)) unit = {1, 0, 0};
    tangent = {unit.x, unit.y, unit.z, tangent.w < 0 ? -side : side};
  }
}

}  // namespace luciole
