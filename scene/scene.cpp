// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <cmath>

namespace luciole {

std::uint64_t Scene::triangle_count() const {
  std::uint64_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.indices.size() / 3;
  return count;
}

Bounds Scene::bounds() const {
  Bounds box;
  for (const Mesh& mesh : meshes) {
    for (const std::uint32_t index : mesh.indices) box.grow(mesh.positions[index]);
  }
  return box;
}

Camera look_at(Vec3 eye, Vec3 target, float vertical_fov) {
  Camera camera;
  camera.eye = eye;
  camera.vertical_fov = vertical_fov;
  const Vec3 towards = target - eye;
  const float distance = length(towards);
  camera.forward = distance > 0 ? towards / distance : Vec3(0, 0, -1);
  // Straight up or down there is no horizon to keep level: +X stays to the right.
  const Vec3 side = cross(camera.forward, Vec3(0, 1, 0));
  const float side_length = length(side);
  camera.right = side_length > 1e-6f ? side / side_length : Vec3(1, 0, 0);
  camera.up = cross(camera.right, camera.forward);
  return camera;
}

}  // namespace luciole
