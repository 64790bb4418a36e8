// SPDX-License-Identifier: Apache-2.0
// Rib vaults: over each bay the elliptic barrel across the hall meets the one along it. Both rise equally, so the
// groins are straight diagonals in plan, and each quarter of a bay is ruled between a diagonal and an edge.
#include <cmath>

#include "scene/recipes/gallery/hall.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {
namespace {

constexpr float kHalfBay = kBayLength / 2;

// s spaced by angle, so that the steep feet of the arch are cut as finely as its crown; the ends are exact.
float arch_place(float u) { return u == 0 ? -1.0f : (u == 1 ? 1.0f : -std::cos(kPi * u)); }

// Bricks are laid along the barrel: u is the way round the arch, v the place along the barrel's axis. [m]
void lay_bricks(Mesh& web, const GridShape& shape, float half_span, float Vec3::*axis) {
  float way = 0;
  for (std::uint32_t i = 0; i <= shape.columns; ++i) {
    const float s = arch_place(static_cast<float>(i) / static_cast<float>(shape.columns));
    if (i > 0) {
      const float before = arch_place(static_cast<float>(i - 1) / static_cast<float>(shape.columns));
      way += std::hypot(half_span * (s - before), vault_height(s) - vault_height(before));
    }
    for (std::uint32_t j = 0; j <= shape.rows; ++j) {
      const std::size_t vertex = std::size_t(j) * (shape.columns + 1) + i;
      web.uv[0][vertex] = {web.positions[vertex].*axis, way};
    }
  }
}

// The web on the wall side `side` (-1 or 1) of a bay, from the groins to the wall: a barrel along x.
Mesh wall_web(float side, Detail detail) {
  const GridShape shape{detail.segments(64), detail.segments(24), false, false, {1, 1}};
  Mesh web = grid_surface(shape, [&](float u, float v) {
    const float s = arch_place(u), x = std::abs(s) + v * (1 - std::abs(s));
    return Vec3{side * kHalfWidth * x, vault_height(s), -side * kHalfBay * s};
  });
  lay_bricks(web, shape, kHalfBay, &Vec3::x);
  return web;
}

// The web between two bays' groins, over the half of the bay on `side` along z: a barrel along z.
Mesh hall_web(float side, Detail detail) {
  const GridShape shape{detail.segments(72), detail.segments(20), false, false, {1, 1}};
  Mesh web = grid_surface(shape, [&](float u, float v) {
    const float s = arch_place(u), z = std::abs(s) + v * (1 - std::abs(s));
    return Vec3{side * kHalfWidth * s, vault_height(s), side * kHalfBay * z};
  });
  lay_bricks(web, shape, kHalfWidth, &Vec3::z);
  return web;
}

// A rib under the vault along a straight line in plan from -ends to +ends.
Mesh rib(Vec3 ends, float width, float drop, Detail detail) {
  const std::vector<Vec2> section = closed_line({{-width / 2, 0.04f, 0.001f},
                                                 {-width / 2, -drop * 0.35f, 0.006f},
                                                 {-width * 0.28f, -drop * 0.55f, 0.006f},
                                                 {-width * 0.2f, -drop, 0.03f},
                                                 {width * 0.2f, -drop, 0.03f},
                                                 {width * 0.28f, -drop * 0.55f, 0.006f},
                                                 {width / 2, -drop * 0.35f, 0.006f},
                                                 {width / 2, 0.04f, 0.001f}},
                                                20);
  // The section's "up" is away from the middle of the springing line, so that the rib hangs off the vault.
  const auto path = curve(detail.segments(60, 12) + 1, false, [&](float along) {
    const float s = arch_place(along);
    return Vec3{ends.x * s, vault_height(s), ends.z * s};
  });
  const Vec3 across = normalize(cross(Vec3{0, 1, 0}, ends));
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3 ahead = path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0];
    const Vec3 outwards = normalize(cross(ahead, across));
    for (std::size_t k = 0; k <= section.size(); ++k) {
      const Vec2 p = section[k % section.size()];
      points.push_back(path[i] + across * p.x + outwards * p.y);
    }
  }
  const GridShape shape{static_cast<std::uint32_t>(section.size()),
                        static_cast<std::uint32_t>(path.size() - 1),
                        true,
                        false,
                        {width * 3, 8}};
  return grid_from_points(shape, std::move(points));
}

// The boss where the diagonal ribs cross.
Mesh boss(Detail detail) {
  return lathe(open_line({{0, -0.20f, kCrisp},
                          {0.05f, -0.19f},
                          {0.09f, -0.13f},
                          {0.16f, -0.15f, kCrisp},
                          {0.24f, -0.10f},
                          {0.26f, -0.03f},
                          {0.24f, 0.05f, kCrisp},
                          {0, 0.05f, kCrisp}},
                         detail.segments(24)),
               detail.segments(48));
}

}  // namespace

float vault_height(float s) { return kSpringing + kRise * std::sqrt(std::max(0.0f, 1 - s * s)); }

void add_vault(Scene& scene, const HallMaterials& materials, Detail detail) {
  Mesh webs, ribs;
  for (int bay = 0; bay < kBays; ++bay) {
    const Affine place = translate({0, 0, bay_centre(bay)});
    for (const float side : {-1.0f, 1.0f}) {
      append(webs, wall_web(side, detail), place);
      append(webs, hall_web(side, detail), place);
      append(ribs, rib({kHalfWidth, 0, side * kHalfBay}, 0.22f, 0.17f, detail), place);
    }
    append(ribs, boss(detail), place * translate({0, kSpringing + kRise, 0}));
  }
  for (int border = 0; border <= kBays; ++border) {
    append(ribs, rib({kHalfWidth, 0, 0}, 0.44f, 0.24f, detail),
           translate({0, 0, static_cast<float>(border) * kBayLength - kHalfLength}));
  }
  for (int bay = 0; bay < kBays; ++bay) {
    for (const float side : {-1.0f, 1.0f}) {
      append(ribs, rib({0, 0, kHalfBay}, 0.2f, 0.14f, detail), translate({side * kHalfWidth, 0, bay_centre(bay)}));
    }
  }
  scale_uv(webs, kBrickTile);
  scale_uv(ribs, kStoneTile);
  add_tangents(webs);
  add_tangents(ribs);
  add_mesh(scene, "vault", materials.brick, std::move(webs));
  add_mesh(scene, "ribs", materials.limestone, std::move(ribs));
}

}  // namespace luciole::workshop::gallery
