// SPDX-License-Identifier: Apache-2.0
// Scenes of a few triangles for the tests of the front half of the frame.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "ray_tracing/ray_scene.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "scene/scene.h"

namespace luciole::front_test {

inline Vec3 at(const Plane3& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }

// A parallelogram; its front is where edge_u x edge_v points.
inline Mesh quad(Vec3 corner, Vec3 edge_u, Vec3 edge_v, std::uint32_t material = 0) {
  Mesh mesh;
  mesh.material = material;
  mesh.positions = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  mesh.uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

// A ball of rings x 2 rings facets, fronts outside, with the ball's normals.
inline Mesh ball(Vec3 centre, float radius, std::uint32_t rings) {
  Mesh mesh;
  const std::uint32_t columns = 2 * rings + 1;
  for (std::uint32_t row = 0; row <= rings; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const float theta = std::numbers::pi_v<float> * float(row) / float(rings);
      const float phi = std::numbers::pi_v<float> * float(column) / float(rings);
      const Vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
      mesh.positions.push_back(centre + n * radius);
      mesh.normals.push_back(n);
    }
  }
  for (std::uint32_t row = 0; row < rings; ++row) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column, b = a + 1, c = a + columns, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
  }
  return mesh;
}

// A room x, z in [-2, 2], y in [0, 3], fronts inside, with a ball in it. Matte grey but for a metal ball.
inline std::shared_ptr<Scene> room_with_ball() {
  auto scene = std::make_shared<Scene>();
  scene->materials.resize(2);
  scene->materials[0].base_colour = {0.6f, 0.5f, 0.4f, 1};
  scene->materials[0].metallic = 0;
  scene->materials[1].roughness = 0.4f;
  scene->meshes = {quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), quad({-2, 3, -2}, {4, 0, 0}, {0, 0, 4}),
                   quad({-2, 0, -2}, {4, 0, 0}, {0, 3, 0}), quad({2, 0, 2}, {-4, 0, 0}, {0, 3, 0}),
                   quad({-2, 0, 2}, {0, 0, -4}, {0, 3, 0}), quad({2, 0, -2}, {0, 0, 4}, {0, 3, 0}),
                   ball({0.5f, 0.8f, -0.6f}, 0.7f, 48)};
  scene->meshes[6].material = 1;
  return scene;
}

inline RayScene traceable(std::shared_ptr<const Scene> scene) {
  Result<RayScene> made = RayScene::create(std::move(scene));
  if (!made) ADD_FAILURE() << made.error().message;
  return std::move(*made);
}

// FNV-1a over the bits of planes.
class PlaneHash {
 public:
  template <class T>
  void add(const AlignedVector<T>& plane) {
    for (const T& value : plane) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof(bits));
      hash_ = (hash_ ^ bits) * 1099511628211ull;
    }
  }
  void add(const Plane3& planes) {
    for (const Plane& plane : planes) add(plane);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ull;
};

}  // namespace luciole::front_test
