// SPDX-License-Identifier: Apache-2.0
#include "scene/ply_text.h"

#include <array>
#include <bit>

namespace luciole {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

template <class T>
void append_bytes(std::string& text, const T& value) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  text.append(bytes.data(), bytes.size());
}

bool has_area(const Mesh& mesh, const std::uint32_t* corner) {
  const Vec3 a = mesh.positions[corner[0]];
  return length(cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a)) > 0;
}

}  // namespace

std::string ply_text(const Mesh& mesh) {
  std::string faces;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t* corner = &mesh.indices[i];
    if (!has_area(mesh, corner)) continue;
    faces += '\3';
    for (int k = 0; k < 3; ++k) append_bytes(faces, corner[k]);
    ++count;
  }
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!mesh.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  text += "element face " + std::to_string(count) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    append_bytes(text, mesh.positions[i]);
    if (!mesh.normals.empty()) append_bytes(text, mesh.normals[i]);
  }
  return text + faces;
}

}  // namespace luciole
