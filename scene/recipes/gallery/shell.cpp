// SPDX-License-Identifier: Apache-2.0
// Floor, walls and windows. Walls end at the vault: each bay's wall is topped by the arch of its web.
#include <cmath>
#include <functional>

#include "scene/recipes/gallery/hall.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {
namespace {

using Height = std::function<float(float z)>;  // over the wall's horizontal coordinate

// A piece of a wall between two heights, for a horizontal coordinate running from `from` to `to`; the front is on the
// side of cross(to - from, up).
Mesh wall_piece(const std::function<Vec3(float)>& foot, Vec2 from_to, Height low, Height high, std::uint32_t columns) {
  Mesh mesh = grid_surface({columns, 1, false, false, {1, 1}}, [&](float u, float v) {
    const float at = std::lerp(from_to.x, from_to.y, u);
    return foot(at) + Vec3{0, std::lerp(low(at), high(at), v), 0};
  });
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const Vec3 p = mesh.positions[k];
    mesh.uv[0][k] = {p.x + p.z, -p.y};  // walls run along x or along z
  }
  return mesh;
}

Height level(float height) {
  return [height](float) { return height; };
}

// The opening's outline in (z, y) relative to the middle of the bay, narrowed by `inset`: counter-clockwise with z to
// the right and y upwards. [m]
std::vector<Vec2> window_outline(float inset, std::uint32_t arc_samples) {
  const float w = kWindowHalfWidth - inset;
  std::vector<Vec2> outline = {{-w, kWindowSill + inset}, {w, kWindowSill + inset}};
  for (std::uint32_t i = 0; i <= arc_samples; ++i) {
    const float angle = kPi * static_cast<float>(i) / static_cast<float>(arc_samples);
    outline.push_back({w * std::cos(angle), kWindowSpringing + w * std::sin(angle)});
  }
  return outline;
}

// The wall of one bay round its window.
Mesh window_wall(float middle, Detail detail) {
  const auto foot = [](float z) { return Vec3{-kHalfWidth, 0, z}; };
  const float half = kBayLength / 2, w = kWindowHalfWidth;
  const Height lunette = [=](float z) { return vault_height((z - middle) / half); };
  const Height head = [=](float z) {
    return kWindowSpringing + std::sqrt(std::max(0.0f, w * w - (z - middle) * (z - middle)));
  };
  Mesh wall;
  const std::uint32_t columns = detail.segments(48, 12);
  append(wall, wall_piece(foot, {middle + half, middle + w}, level(0), lunette, columns));
  append(wall, wall_piece(foot, {middle + w, middle - w}, level(0), level(kWindowSill), 1));
  append(wall, wall_piece(foot, {middle + w, middle - w}, head, lunette, 2 * columns));
  append(wall, wall_piece(foot, {middle - w, middle - half}, level(0), lunette, columns));
  return wall;
}

// The splayed sides of a window: wide inside, narrower at the glass.
Mesh reveal(float middle, Detail detail) {
  const auto arc = detail.segments(64, 12);
  const std::vector<Vec2> inner = window_outline(0, arc), outer = window_outline(0.14f, arc);
  const auto columns = static_cast<std::uint32_t>(inner.size());
  Mesh mesh;
  for (std::uint32_t i = 0; i < columns; ++i) {  // one flat strip each, but for the arch, which is smooth
    const bool arch = i >= 2 && i + 1 < columns;
    if (arch && i > 2) continue;
    const std::uint32_t steps = arch ? arc : 1;
    append(mesh, grid_surface({steps, 1, false, false, {4, kWallThickness}}, [&](float u, float v) {
             const auto k = (i + static_cast<std::uint32_t>(std::lround(u * static_cast<float>(steps)))) % columns;
             const Vec2 p = v == 0 ? outer[k] : inner[k];
             return Vec3{-kHalfWidth - (v == 0 ? kWallThickness : 0), p.y, middle + p.x};
           }));
  }
  return mesh;
}

// Frame, mullions and glazing bars at the outer side of the wall.
Mesh glazing(float middle, Detail detail) {
  const float x = -kHalfWidth - kWallThickness + 0.06f;
  const auto place = [=](Vec2 p) { return Vec3{x, p.y, middle + p.x}; };
  Mesh mesh;
  std::vector<Vec3> frame;
  for (const Vec2 p : window_outline(0.16f, detail.segments(48, 12))) frame.push_back(place(p));
  append(mesh, sweep({frame, true, rounded_rectangle({0.07f, 0.10f}, 0.012f), nullptr, Vec3{1, 0, 0}}));
  const float w = kWindowHalfWidth - 0.16f;
  const auto bar = [&](Vec2 a, Vec2 b, float thick) {
    append(mesh, sweep({{place(a), place(b)},
                        false,
                        rounded_rectangle({thick, thick * 1.4f}, thick * 0.2f),
                        nullptr,
                        Vec3{1, 0, 0}}));
  };
  for (const float z : {-w / 2, 0.0f, w / 2}) bar({z, kWindowSill + 0.16f}, {z, kWindowSpringing}, 0.05f);
  for (int row = 1; row <= 4; ++row) {
    const float y = std::lerp(kWindowSill + 0.16f, kWindowSpringing, static_cast<float>(row) / 4);
    bar({-w, y}, {w, y}, row == 4 ? 0.07f : 0.035f);
  }
  for (const float degrees : {36.0f, 72.0f, 108.0f, 144.0f}) {  // the fan in the arch
    const Vec2 ray{std::cos(radians(degrees)), std::sin(radians(degrees))};
    bar(Vec2{0, kWindowSpringing} + ray * (0.36f * w), Vec2{0, kWindowSpringing} + ray * w, 0.035f);
  }
  append(mesh,
         tube(curve(detail.segments(32, 8) + 1, false,
                    [&](float along) {
                      const float angle = kPi * along;
                      return place(Vec2{0, kWindowSpringing} + Vec2{std::cos(angle), std::sin(angle)} * (0.36f * w));
                    }),
              0.022f, 8));
  return mesh;
}

// A projecting moulding round the window on the inner side of the wall, and its sill.
Mesh window_trim(float middle, Detail detail) {
  std::vector<Vec3> path;
  for (const Vec2 p : window_outline(-0.05f, detail.segments(64, 12))) path.push_back({-kHalfWidth, p.y, middle + p.x});
  Mesh mesh = sweep({path, true,
                     closed_line({{-0.10f, -0.02f, 0.002f},
                                  {0.10f, -0.02f, 0.002f},
                                  {0.10f, 0.04f, 0.008f},
                                  {0.03f, 0.07f, 0.01f},
                                  {-0.05f, 0.07f, 0.02f},
                                  {-0.10f, 0.02f, 0.008f}},
                                 12),
                     nullptr, Vec3{1, 0, 0}});
  append(mesh, rounded_box({0.34f, 0.09f, 2 * kWindowHalfWidth + 0.36f}, 0.015f),
         translate({-kHalfWidth + 0.05f, kWindowSill - 0.06f, middle}));
  return mesh;
}

}  // namespace

void add_shell(Scene& scene, const HallMaterials& materials, Detail detail) {
  Mesh floor = rectangle({-kHalfWidth, 0, kHalfLength}, {2 * kHalfWidth, 0, 0}, {0, 0, -2 * kHalfLength});
  Mesh walls, stone, bars;
  for (int bay = 0; bay < kBays; ++bay) {
    const float middle = bay_centre(bay);
    append(walls, window_wall(middle, detail));
    append(walls, reveal(middle, detail));
    append(walls, wall_piece(
                      [](float z) {
                        return Vec3{kHalfWidth, 0, z};
                      },
                      {middle - kBayLength / 2, middle + kBayLength / 2}, level(0),
                      [=](float z) { return vault_height((z - middle) / (kBayLength / 2)); }, detail.segments(96, 16)));
    append(stone, window_trim(middle, detail));
    append(bars, glazing(middle, detail));
  }
  for (const float side : {-1.0f, 1.0f}) {
    append(walls, wall_piece(
                      [=](float x) {
                        return Vec3{x, 0, side * kHalfLength};
                      },
                      {side * kHalfWidth, -side * kHalfWidth}, level(0),
                      [](float x) { return vault_height(x / kHalfWidth); }, detail.segments(96, 16)));
  }
  scale_uv(floor, kFloorTile);
  scale_uv(walls, kPlasterTile);
  scale_uv(stone, kStoneTile);
  for (Mesh* mesh : {&floor, &walls, &stone}) add_tangents(*mesh);
  add_mesh(scene, "floor", materials.marble_floor, std::move(floor));
  add_mesh(scene, "walls", materials.plaster, std::move(walls));
  add_mesh(scene, "window surrounds", materials.limestone, std::move(stone));
  add_mesh(scene, "window bars", materials.lead, std::move(bars));
}

}  // namespace luciole::workshop::gallery
