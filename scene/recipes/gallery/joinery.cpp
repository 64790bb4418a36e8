// SPDX-License-Identifier: Apache-2.0
// Carpenters' and carpet weavers' work: doors, baseboards, a cornice line under the windows, a carpet.
#include <cmath>

#include "scene/recipes/gallery/hall.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {
namespace {

// A panelled double door in a stone frame, in the plane z = 0, facing +z, standing on y = 0.
void add_door(Mesh& wood, Mesh& stone, const Affine& place) {
  constexpr float kWidth = 1.9f, kHeight = 2.9f;
  for (const float leaf : {-1.0f, 1.0f}) {
    const float x = leaf * kWidth / 4;
    append(wood, rounded_box({kWidth / 2 - 0.01f, kHeight, 0.06f}, 0.008f), place * translate({x, kHeight / 2, 0.03f}));
    for (const Vec2 span : {Vec2{0.18f, 0.95f}, Vec2{1.10f, 1.95f}, Vec2{2.10f, 2.74f}}) {
      const std::vector<Vec2> plan = rounded_rectangle({kWidth / 2 - 0.3f, span.y - span.x}, 0.002f);
      const Mesh panel = moulding(plan, {{0.05f, 0},
                                         {0.045f, 0.02f},
                                         {0.02f, 0.028f},
                                         {0, 0.012f},
                                         {-0.02f, 0.008f},
                                         {-0.07f, 0.022f},
                                         {-0.16f, 0.024f}});
      append(wood, panel, place * translate({x, (span.x + span.y) / 2, 0.06f}) * rotate_x(kPi / 2));
      append(wood, rounded_box({kWidth / 2 - 0.6f, span.y - span.x - 0.3f, 0.024f}, 0.002f),
             place * translate({x, (span.x + span.y) / 2, 0.072f}));
    }
  }
  for (const float side : {-1.0f, 1.0f}) {
    append(stone, rounded_box({0.24f, kHeight + 0.1f, 0.16f}, 0.02f),
           place * translate({side * (kWidth / 2 + 0.12f), kHeight / 2 + 0.05f, 0.08f}));
  }
  append(stone, rounded_box({kWidth + 0.72f, 0.26f, 0.20f}, 0.02f), place * translate({0, kHeight + 0.2f, 0.10f}));
  append(stone, rounded_box({kWidth + 0.92f, 0.09f, 0.30f}, 0.02f), place * translate({0, kHeight + 0.37f, 0.15f}));
}

// A baseboard and a string course along the walls between columns.
void add_wall_lines(Mesh& stone) {
  const std::vector<Vec2> board = open_line({{0, 0, kCrisp},
                                             {0.05f, 0, kCrisp},
                                             {0.05f, 0.26f, 0.01f},
                                             {0.035f, 0.29f},
                                             {0.02f, 0.34f, 0.01f},
                                             {-0.02f, 0.34f, kCrisp}},
                                            10);
  // One moulding all round the inside of the hall: an inside corner is a plan that runs clockwise.
  std::vector<Vec2> plan = {
      {-kHalfWidth, -kHalfLength}, {-kHalfWidth, kHalfLength}, {kHalfWidth, kHalfLength}, {kHalfWidth, -kHalfLength}};
  append(stone, moulding(plan, board));
}

Mesh carpet(Detail detail) {
  const std::uint32_t columns = detail.segments(48, 8), rows = detail.segments(96, 8);
  Mesh mesh = grid_surface({columns, rows, false, false, {1, 1}}, [](float u, float v) {
    // It lies almost flat: a low wave here and there, and its rim on the floor.
    const float rim = std::min({u * 24, (1 - u) * 24, v * 48, (1 - v) * 48, 1.0f});
    const float wave = 0.007f * (std::sin(7.1f * u + 3.3f * v) + std::sin(11 * v - 4 * u)) + 0.016f;
    return Vec3{2.4f * (u - 0.5f), 0.001f + wave * rim, 4.8f * (0.5f - v)};
  });
  return mesh;
}

}  // namespace

void add_joinery(Scene& scene, const HallMaterials& materials, Detail detail) {
  Mesh wood, stone;
  add_door(wood, stone, translate({-0.6f, 0, -kHalfLength}));
  // At the head of the stairs.
  add_door(wood, stone, translate({2.56f, 3.3f, -kHalfLength}) * scale({0.69f, 0.69f, 0.69f}));
  add_door(wood, stone, translate({0, 0, kHalfLength}) * rotate_y(kPi));
  add_wall_lines(stone);
  Mesh rug = placed(carpet(detail), translate({-0.9f, 0, -5.2f}));
  scale_uv(wood, kOakTile);
  scale_uv(stone, kStoneTile);
  for (Mesh* mesh : {&wood, &stone, &rug}) add_tangents(*mesh);
  add_mesh(scene, "doors", materials.oak, std::move(wood));
  add_mesh(scene, "frames and baseboards", materials.limestone, std::move(stone));
  add_mesh(scene, "carpet", materials.carpet, std::move(rug));
}

}  // namespace luciole::workshop::gallery
