// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/colonnade.h"

#include "scene/recipes/metals.h"
#include "scene/recipes/scene_kit.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop {
namespace {

Mesh hall_walls(const HallSize& s) {
  Mesh walls;
  const float x = s.width / 2, z = s.length / 2;
  append(walls, rectangle({-x, 0, -z}, {s.width, 0, 0}, {0, s.height, 0}));
  append(walls, rectangle({x, 0, z}, {-s.width, 0, 0}, {0, s.height, 0}));
  append(walls, rectangle({-x, 0, z}, {0, 0, -s.length}, {0, s.height, 0}));
  append(walls, rectangle({x, 0, -z}, {0, 0, s.length}, {0, s.height, 0}));
  append(walls, rectangle({-x, s.height, -z}, {s.width, 0, 0}, {0, 0, s.length}));
  return walls;
}

// A column from floor to ceiling: base, swelling shaft, capital.
Mesh column(float height) {
  const float top = height;
  Mesh whole = lathe(open_line({{0.30f, 0.12f, kCrisp},
                                {0.34f, 0.18f},
                                {0.30f, 0.24f, kCrisp},
                                {0.25f, 0.28f, kCrisp},
                                {0.25f, 1.4f},
                                {0.21f, top - 0.5f, kCrisp},
                                {0.24f, top - 0.46f},
                                {0.21f, top - 0.42f, kCrisp},
                                {0.22f, top - 0.38f},
                                {0.34f, top - 0.2f, kCrisp},
                                {0.30f, top - 0.16f, kCrisp}},
                               30),
                     24);
  append(whole, rounded_box({0.76f, 0.14f, 0.76f}, 0.01f), translate({0, 0.07f, 0}));
  append(whole, rounded_box({0.76f, 0.18f, 0.76f}, 0.01f), translate({0, top - 0.09f, 0}));
  return whole;
}

Mesh jar() {
  return lathe(open_line({{0, 0, kCrisp},
                          {0.16f, 0, kCrisp},
                          {0.30f, 0.35f},
                          {0.12f, 0.72f},
                          {0.19f, 0.86f, kCrisp},
                          {0.10f, 0.74f},
                          {0, 0.55f, kCrisp}},
                         40),
               64);
}

}  // namespace

void add_colonnade(Scene& scene, const HallSize& size) {
  const auto plaster = add_material(scene, matte_material("plaster", {0.72f, 0.69f, 0.63f}));
  const auto stone = add_material(scene, dielectric_material("polished stone", {0.38f, 0.36f, 0.34f}, 0.25f));
  const auto block = add_material(scene, matte_material("block", {0.45f, 0.22f, 0.15f}));
  const float x = size.width / 2, z = size.length / 2;
  add_mesh(scene, "walls", plaster, hall_walls(size));
  add_mesh(scene, "floor", stone, rectangle({-x, 0, z}, {size.width, 0, 0}, {0, 0, -size.length}));
  Mesh columns, blocks;
  for (int row = 0; row < 5; ++row) {
    const float at = size.length * (0.18f * static_cast<float>(row) - 0.36f);
    for (const float side : {-0.3f, 0.3f}) append(columns, column(size.height), translate({side * size.width, 0, at}));
    const float angle = 0.5f + 1.3f * static_cast<float>(row), wide = 0.5f + 0.12f * static_cast<float>(row);
    append(blocks, rounded_box({wide, 0.5f, wide}, 0.01f),
           translate({row % 2 == 0 ? -1.3f : 1.4f, 0.25f, at + 0.9f}) * rotate_y(angle));
  }
  add_mesh(scene, "columns", plaster, std::move(columns));
  add_mesh(scene, "blocks", block, std::move(blocks));
  add_mesh(scene, "ball", add_material(scene, metal_material("ball", metal::kSilver, 0.12f)),
           placed(grid_surface(
                      {64, 32, true, false, {1, 1}},
                      [](float u, float v) {
                        const float r = 0.45f * std::sin(kPi * v), y = -0.45f * std::cos(kPi * v);
                        return Vec3{v == 1 ? 0 : r * std::cos(kTwoPi * u), y, v == 1 ? 0 : -r * std::sin(kTwoPi * u)};
                      }),
                  translate({0.2f, 0.45f, z * 0.35f})));
  add_mesh(scene, "jar", add_material(scene, metal_material("jar", metal::kBrass, 0.2f)),
           placed(jar(), translate({-0.9f, 0, z * 0.12f})));
}

}  // namespace luciole::workshop
