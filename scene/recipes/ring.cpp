// SPDX-License-Identifier: Apache-2.0
// A metal band on a plane, after [TH17] Fig. 10: light that passes over the near wall is thrown back by the inner side
// of the far wall and draws a caustic with a cusp inside the ring.
#include <algorithm>
#include <cmath>

#include "scene/recipes/metals.h"
#include "scene/recipes/recipe_list.h"
#include "scene/recipes/scene_kit.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop {
namespace {

// 2 x 105 x 39 = 8,190 triangles, and the plane has two.
constexpr std::uint32_t kColumns = 105, kRows = 39;

// The band's cross-section: inner radius 0.50 m, wall 0.06 m, height 0.30 m, edges rounded, standing on y = 0. Points
// are spaced evenly so that flat and round parts get the same care.
std::vector<Vec2> cross_section(std::uint32_t rows) {
  std::vector<Vec2> loop;
  constexpr float kWall = 0.06f, kHeight = 0.30f, kRound = 0.02f;
  const float straight_x = kWall - 2 * kRound, straight_y = kHeight - 2 * kRound, arc = kRound * kPi / 2;
  const float around = 2 * (straight_x + straight_y) + 4 * arc;
  for (std::uint32_t i = 0; i < rows; ++i) {
    float s = around * static_cast<float>(i) / static_cast<float>(rows);
    int corner = 0;  // walk the loop: right side up, arc, top to the left, arc, left side down, arc, bottom, arc
    float side = straight_y;
    while (s >= side + arc) {
      s -= side + arc;
      side = ++corner % 2 == 0 ? straight_y : straight_x;
    }
    const float angle = kPi / 2 * static_cast<float>(corner) + (s > side ? (s - side) / kRound : 0.0f);
    const Vec2 centre{corner == 0 || corner == 3 ? straight_x / 2 : -straight_x / 2,
                      corner < 2 ? straight_y / 2 : -straight_y / 2};
    const float left = std::min(s, side) - side;  // how far before the arc, negative
    const Vec2 along{-std::sin(kPi / 2 * static_cast<float>(corner)), std::cos(kPi / 2 * static_cast<float>(corner))};
    loop.push_back(Vec2{0.53f, kHeight / 2} + centre + Vec2{std::cos(angle), std::sin(angle)} * kRound + along * left);
  }
  return loop;
}

Mesh band(std::uint32_t columns, std::uint32_t rows) {
  const std::vector<Vec2> section = cross_section(rows);
  const std::vector<Vec2> turned = circle(1, columns);
  return grid_surface({columns, rows, true, true, {kTwoPi * 0.53f, 0.72f}}, [&](float u, float v) {
    const Vec2 p = section[static_cast<std::size_t>(std::lround(v * static_cast<float>(rows))) % rows];
    const Vec2 c = turned[static_cast<std::size_t>(std::lround(u * static_cast<float>(columns))) % columns];
    return Vec3{p.x * c.x, p.y, -p.x * c.y};
  });
}

Scene make_ring(const Values& values) {
  const Detail detail{static_cast<float>(values.at("detail"))};
  Scene scene;
  // The plane is matte: all glossy lights of the picture sit on the ring, as in the figure.
  const auto plane = add_material(scene, matte_material("plane", {0.6f, 0.6f, 0.6f}));
  const auto ring = add_material(scene, metal_material("ring", metal::kGold, static_cast<float>(values.at("alpha"))));
  add_mesh(scene, "plane", plane, rectangle({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}));
  add_mesh(scene, "ring", ring, band(detail.segments(kColumns), detail.segments(kRows)));

  scene.lights.push_back(spot_light("spot", {{-3.1f, 1.55f, -1.25f}, {0, 0.1f, 0}}, {80, 80, 80}, 18, 24));
  scene.cameras.push_back(named_camera("ring", {{0.35f, 1.55f, 2.05f}, {0, 0.06f, 0.03f}}, 38));
  return scene;
}

}  // namespace

Recipe ring_recipe() {
  return {{"ring",
           "a glossy gold ring on a matte plane under one spot: a caustic with a cusp (8,192 triangles)",
           {{"alpha", "GGX alpha of the ring", 0.1, 0.001, 1},
            {"detail", "share of the full number of triangles", 1, 0.001, 1}}},
          make_ring};
}

}  // namespace luciole::workshop
