// SPDX-License-Identifier: Apache-2.0
// Affine maps of space, named read-right-to-left: world_from_node * node_from_mesh.
#pragma once
#include "base/vector.h"

namespace luciole {

struct Affine {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // images of the axes (columns)
  Vec3 translation{0, 0, 0};

  Vec3 vector(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 point(Vec3 p) const { return vector(p) + translation; }
  // Normals go by the cofactor matrix (inverse transpose times the determinant): no division, fine for singular maps;
  // the caller normalises. Mirrored maps flip the sign here as they flip the winding.
  Vec3 normal(Vec3 n) const { return cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z; }
  float determinant() const { return dot(x, cross(y, z)); }
};

inline Affine operator*(const Affine& a, const Affine& b) {
  return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.translation)};
}

}  // namespace luciole
