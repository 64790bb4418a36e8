// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "scene/mesh_finish.h"

namespace luciole {
namespace {

struct TriangleGradient {
  Vec3 along_u{0, 0, 0};  // direction in which u grows
  bool upright = true;    // the image is not mirrored: seen from the front, u to the right means v downwards
};

TriangleGradient gradient_of(const Vec3 (&p)[3], const Vec2 (&uv)[3]) {
  const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
  const Vec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
  const float area = d1.x * d2.y - d2.x * d1.y;
  // The sign of the area alone is applied, not its size: only the direction counts.
  return {(e1 * d2.y - e2 * d1.y) * (area < 0 ? -1.0f : 1.0f), area <= 0};
}

float corner_angle(Vec3 corner, Vec3 next, Vec3 previous) {
  const Vec3 a = next - corner, b = previous - corner;
  const float lengths = length(a) * length(b);
  return lengths > 0 ? std::acos(std::clamp(dot(a, b) / lengths, -1.0f, 1.0f)) : 0.0f;
}

// Copies vertex `index` to the end and returns the copy's number.
std::uint32_t duplicate_vertex(Mesh& mesh, std::uint32_t index) {
  const auto copy = [index](auto& values) {
    if (!values.empty()) {
      const auto value = values[index];
      values.push_back(value);
    }
  };
  copy(mesh.positions);
  copy(mesh.normals);
  copy(mesh.uv[0]);
  copy(mesh.uv[1]);
  copy(mesh.colours);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void read_triangle(const Mesh& mesh, const TextureSlot& slot, std::size_t first, Vec3 (&p)[3], Vec2 (&uv)[3]) {
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = mesh.positions[mesh.indices[first + k]];
    uv[k] = slot.transform(mesh.uv[slot.uv_set][mesh.indices[first + k]]);
  }
}

// Each vertex takes the orientation of the first triangle that uses it; corners of the other orientation move to a
// copy. Returns per vertex whether its texture is upright.
std::vector<bool> split_by_orientation(Mesh& mesh, const TextureSlot& slot) {
  const std::size_t vertices = mesh.positions.size();
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> twin(vertices, kNone);
  std::vector<bool> known(vertices, false), upright(vertices, true);
  for (std::size_t first = 0; first + 2 < mesh.indices.size(); first += 3) {
    Vec3 p[3];
    Vec2 uv[3];
    read_triangle(mesh, slot, first, p, uv);
    const bool triangle_upright = gradient_of(p, uv).upright;
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& index = mesh.indices[first + k];
      if (!known[index]) {
        known[index] = true;
        upright[index] = triangle_upright;
      } else if (upright[index] != triangle_upright) {
        if (twin[index] == kNone) {
          twin[index] = duplicate_vertex(mesh, index);
          upright.push_back(triangle_upright);
        }
        index = twin[index];
      }
    }
  }
  return upright;
}

}  // namespace

void add_tangents(Mesh& mesh, const TextureSlot& slot) {
  if (mesh.uv[slot.uv_set].empty()) return;
  if (mesh.normals.empty()) separate_triangles(mesh);  // flat shading: a tangent per triangle
  const std::vector<bool> upright = split_by_orientation(mesh, slot);
  std::vector<Vec3> sums(mesh.positions.size());
  for (std::size_t first = 0; first + 2 < mesh.indices.size(); first += 3) {
    Vec3 p[3];
    Vec2 uv[3];
    read_triangle(mesh, slot, first, p, uv);
    const Vec3 along_u = gradient_of(p, uv).along_u;
    const float size = length(along_u);
    if (!(size > 0) || !std::isfinite(size)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      sums[mesh.indices[first + k]] += along_u * (corner_angle(p[k], p[(k + 1) % 3], p[(k + 2) % 3]) / size);
    }
  }
  // glTF 2.0, 3.7.2.1: the bitangent is cross(normal, tangent) * w and points up in the image, against v.
  mesh.tangents.resize(mesh.positions.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    mesh.tangents[i] = {sums[i].x, sums[i].y, sums[i].z, upright[i] ? 1.0f : -1.0f};
  }
}

}  // namespace luciole
