// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/gallery/materials.h"

#include <algorithm>
#include <cmath>

#include "scene/recipes/hash.h"
#include "scene/recipes/texture_painter.h"

namespace luciole::workshop::gallery {
namespace {

Vec2 wrapped(Vec2 p) { return {p.x - std::floor(p.x), p.y - std::floor(p.y)}; }

// A cell of a grid over the tile, and where in it a place lies.
struct Cell {
  std::uint32_t column, row;
  Vec2 inside;        // in [0,1)
  float edge_metres;  // to the nearest side of the cell
};

Cell cell_of(Vec2 place, Vec2 cells, float tile_metres, float row_shift) {
  const float y = place.y * cells.y;
  const auto row = static_cast<std::uint32_t>(y);
  const float x = wrapped({place.x + row_shift * static_cast<float>(row % 2) / cells.x, 0}).x * cells.x;
  Cell cell{static_cast<std::uint32_t>(x), row, {x - std::floor(x), y - std::floor(y)}, 0};
  const float across = std::min(cell.inside.x, 1 - cell.inside.x) / cells.x;
  const float down = std::min(cell.inside.y, 1 - cell.inside.y) / cells.y;
  cell.edge_metres = std::min(across, down) * tile_metres;
  return cell;
}

// Every cell cut from another part of the same stone.
Vec2 own_place(Vec2 place, const Cell& cell) {
  const std::uint32_t index = cell.row * 64 + cell.column;
  return wrapped(place + Vec2{unit_hash(5, index, 0), unit_hash(5, index, 1)});
}

constexpr float kGrout = 0.0035f;  // half width of the joints between floor slabs [m]

Vec3 marble(Vec2 place) {
  const Cell cell = cell_of(place, {4, 4}, kFloorTile, 0);
  if (cell.edge_metres < kGrout) return {0.20f, 0.18f, 0.15f};
  const Vec2 at = own_place(place, cell);
  const float cloud = tiling_fractal(at, 5, 5, 11);
  const float vein = std::pow(std::max(0.0f, 1 - std::abs(tiling_fractal(at, 3, 6, 23)) * 9), 2.0f);
  const float fine = std::pow(std::max(0.0f, 1 - std::abs(tiling_fractal(at, 9, 5, 37)) * 12), 2.0f);
  const float shade = 0.92f + 0.16f * unit_hash(9, cell.row * 64 + cell.column, 2);
  if ((cell.column + cell.row) % 2 == 0) {
    const Vec3 cream = blend({0.64f, 0.59f, 0.52f}, {0.75f, 0.71f, 0.65f}, 0.5f + cloud);
    return blend(cream, {0.36f, 0.29f, 0.21f}, 0.55f * vein + 0.25f * fine) * shade;
  }
  const Vec3 verde = blend({0.15f, 0.17f, 0.165f}, {0.27f, 0.295f, 0.285f}, 0.5f + 1.3f * cloud);
  return blend(verde, {0.50f, 0.52f, 0.46f}, 0.7f * vein + 0.3f * fine) * shade;
}

float marble_height(Vec2 place) {
  const Cell cell = cell_of(place, {4, 4}, kFloorTile, 0);
  const float tilt = 0.0012f * ((unit_hash(3, cell.row * 64 + cell.column, 0) - 0.5f) * (cell.inside.x - 0.5f) +
                                (unit_hash(3, cell.row * 64 + cell.column, 1) - 0.5f) * (cell.inside.y - 0.5f));
  return tilt + 0.0025f * smooth_step(0.5f * kGrout, 2.2f * kGrout, cell.edge_metres);
}

// Lime plaster, scored while it was wet to look like ashlar of 1 m by 0.5 m, for a bare wall of this size has no scale.
// Blocks differ a little in tone; stains end at no joint.
constexpr float kScore = 0.007f;  // half width of the scored joints [m]
Cell ashlar_cell(Vec2 place) { return cell_of(place, {2, 4}, kPlasterTile, 0.5f); }

Vec3 plaster(Vec2 place) {
  const float stain = tiling_fractal(place, 2, 5, 41), grain = tiling_noise(place, 160, 43);
  const Cell cell = ashlar_cell(place);
  const float tone = 0.94f + 0.12f * unit_hash(19, cell.row * 64 + cell.column, 0);
  const float joint = 1 - smooth_step(0.6f * kScore, 1.4f * kScore, cell.edge_metres);
  return blend({0.68f, 0.64f, 0.57f}, {0.80f, 0.77f, 0.71f}, 0.5f + 1.2f * stain) * (1 + 0.02f * grain) * tone *
         (1 - 0.35f * joint);
}

float plaster_height(Vec2 place) {
  return 0.006f * tiling_fractal(place, 4, 3, 47) + 0.0016f * tiling_fractal(place, 48, 3, 53) +
         0.008f * smooth_step(0.4f * kScore, 1.8f * kScore, ashlar_cell(place).edge_metres);
}

Vec3 limestone(Vec2 place) {
  const float cloud = tiling_fractal(place, 4, 5, 59);
  const float pore = smooth_step(0.38f, 0.6f, tiling_noise(place, 96, 61));
  return blend({0.56f, 0.52f, 0.45f}, {0.71f, 0.68f, 0.62f}, 0.5f + 1.3f * cloud) * (1 - 0.25f * pore);
}

float limestone_height(Vec2 place) {
  return 0.002f * tiling_fractal(place, 24, 4, 67) - 0.0015f * smooth_step(0.38f, 0.6f, tiling_noise(place, 96, 61));
}

constexpr float kMortar = 0.005f;
Cell brick_cell(Vec2 place) { return cell_of(place, {5, 16}, kBrickTile, 0.5f); }

Vec3 brick(Vec2 place) {
  const Cell cell = brick_cell(place);
  const std::uint32_t index = cell.row * 64 + cell.column;
  const float grain = tiling_fractal(place, 40, 4, 71);
  const Vec3 burnt = blend({0.52f, 0.28f, 0.17f}, {0.66f, 0.43f, 0.29f}, unit_hash(13, index, 0));
  const Vec3 clay = blend(burnt, {0.40f, 0.22f, 0.16f}, 0.35f * unit_hash(13, index, 1)) * (1 + 0.35f * grain);
  const float mortar = 1 - smooth_step(0.7f * kMortar, 1.3f * kMortar, cell.edge_metres + 0.003f * grain);
  return blend(clay, {0.56f, 0.51f, 0.43f}, mortar);
}

float brick_height(Vec2 place) {
  const Cell cell = brick_cell(place);
  const float grain = tiling_fractal(place, 40, 4, 71);
  return 0.006f * smooth_step(0.5f * kMortar, 2.0f * kMortar, cell.edge_metres + 0.003f * grain) + 0.003f * grain;
}

// Growth rings, cut lengthwise: the grain runs along u, planks a quarter of the tile wide.
float oak_rings(Vec2 place, std::uint32_t plank) {
  const Vec2 stretched = wrapped({place.x, place.y + 0.37f * static_cast<float>(plank)});
  const float bend = tiling_fractal({stretched.x, stretched.y}, 2, 3, 83);
  const float ring = stretched.y * 44 + 5 * bend;
  return 0.5f + 0.5f * std::sin(kTwoPi * ring);
}

Vec3 oak(Vec2 place) {
  const auto plank = static_cast<std::uint32_t>(place.y * 4);
  const float pore = tiling_noise({wrapped({place.x * 4, 0}).x, place.y}, 192, 89);
  const Vec3 wood = blend({0.155f, 0.080f, 0.038f}, {0.30f, 0.175f, 0.085f}, oak_rings(place, plank));
  return wood * (0.86f + 0.28f * unit_hash(17, plank, 0)) * (1 - 0.12f * std::max(0.0f, pore));
}

float oak_height(Vec2 place) {
  const float seam = std::abs(place.y * 4 - std::round(place.y * 4)) / 4 * kOakTile;
  return 0.0006f * oak_rings(place, static_cast<std::uint32_t>(place.y * 4)) + 0.003f * smooth_step(0.0f, 0.006f, seam);
}

// A carpet of 2.4 x 4.8 m whose one repeat is the whole of it: border, field of lozenges, star in the middle.
Vec3 carpet(Vec2 place) {
  const Vec2 metres{place.x * 2.4f, place.y * 4.8f};
  const float edge = std::min({metres.x, 2.4f - metres.x, metres.y, 4.8f - metres.y});
  const Vec3 red{0.33f, 0.035f, 0.03f}, navy{0.035f, 0.045f, 0.11f}, ivory{0.56f, 0.48f, 0.34f};
  const float yarn = 0.9f + 0.1f * tiling_noise(place, 256, 97) + 0.12f * tiling_fractal(place, 6, 3, 99);
  const auto lozenge = [&](float size) {
    const float x = std::abs(metres.x / size - std::round(metres.x / size));
    const float y = std::abs(metres.y / size - std::round(metres.y / size));
    return x + y;
  };
  if (edge < 0.05f) return navy * yarn;
  if (edge < 0.08f) return ivory * yarn;
  if (edge < 0.32f) return (lozenge(0.24f) < 0.33f ? (lozenge(0.24f) < 0.16f ? red : ivory) : navy) * yarn;
  if (edge < 0.35f) return ivory * yarn;
  const float x = std::abs(metres.x - 1.2f), y = std::abs(metres.y - 2.4f);
  const float medallion = x / 0.62f + y / 1.35f;
  if (medallion < 1) return (medallion > 0.92f ? ivory : (lozenge(0.2f) < 0.3f ? ivory * 0.8f : navy)) * yarn;
  return (lozenge(0.4f) < 0.14f ? ivory : (lozenge(0.4f) < 0.2f ? navy : red)) * yarn;
}

float carpet_height(Vec2 place) { return 0.0025f * tiling_noise(place, 256, 101); }

struct Surface {
  const char* name;
  float tile_metres, ggx_alpha, relief;  // relief: the normal map's strength
  PaintColour colour;
  PaintHeight height;
};

std::uint32_t add_surface(Scene& scene, const Surface& surface, std::uint32_t size) {
  Material material = dielectric_material(surface.name, {1, 1, 1}, surface.ggx_alpha);
  material.base_colour_texture.texture = static_cast<std::int32_t>(scene.textures.size());
  scene.textures.push_back(paint(std::string(surface.name) + " colour", size, Encoding::srgb, surface.colour));
  material.normal_texture.texture = static_cast<std::int32_t>(scene.textures.size());
  scene.textures.push_back(
      paint_normals(std::string(surface.name) + " normals", size, surface.tile_metres, surface.height));
  material.normal_scale = surface.relief;
  return add_material(scene, std::move(material));
}

}  // namespace

HallMaterials add_hall_materials(Scene& scene, std::uint32_t texture_size) {
  const std::uint32_t half = texture_size / 2;
  HallMaterials m{};
  m.marble_floor = add_surface(scene, {"marble floor", kFloorTile, 0.30f, 1, marble, marble_height}, texture_size);
  m.plaster = add_surface(scene, {"plaster", kPlasterTile, 0.9f, 0.6f, plaster, plaster_height}, half);
  m.limestone = add_surface(scene, {"limestone", kStoneTile, 0.7f, 0.8f, limestone, limestone_height}, half);
  m.brick = add_surface(scene, {"brick", kBrickTile, 0.8f, 0.8f, brick, brick_height}, half);
  m.oak = add_surface(scene, {"oak", kOakTile, 0.35f, 1, oak, oak_height}, half);
  m.carpet = add_surface(scene, {"carpet", 2.4f, 1, 1, carpet, carpet_height}, half);
  m.velvet = add_material(scene, dielectric_material("velvet", {0.30f, 0.018f, 0.03f}, 1));
  m.lead = add_material(scene, dielectric_material("window lead", {0.06f, 0.058f, 0.055f}, 0.4f));
  return m;
}

}  // namespace luciole::workshop::gallery
