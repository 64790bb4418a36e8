// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/gallery/exhibits.h"

#include <algorithm>
#include <cmath>

#include "scene/recipes/gallery/hall.h"
#include "scene/recipes/gallery/objects.h"
#include "scene/recipes/metals.h"
#include "scene/recipes/shapes.h"

namespace luciole::workshop::gallery {
namespace {

// Puts metal objects into the scene. Each has an alpha of its own, so that no two glitter alike.
class Showcase {
 public:
  Showcase(Scene& scene, Detail detail) : scene_(scene), detail_(detail) {}
  Detail detail() const { return detail_; }
  void show(const std::string& name, Mesh mesh, const Affine& place, Vec3 f0, float ggx_alpha) {
    add_mesh(scene_, name, add_material(scene_, metal_material(name, f0, ggx_alpha)), placed(mesh, place));
  }

 private:
  Scene& scene_;
  Detail detail_;
};

Affine at(float x, float y, float z, float turn_degrees = 0) {
  return translate({x, y, z}) * rotate_y(radians(turn_degrees));
}

// Turned, and set down on y = 0.
Mesh resting(const Mesh& mesh, const Affine& turn) {
  Mesh turned = placed(mesh, turn);
  float lowest = turned.positions.front().y;
  for (const Vec3 p : turned.positions) lowest = std::min(lowest, p.y);
  return placed(turned, translate({0, -lowest, 0}));
}

// A low plinth: a step with a rounded edge.
Mesh plinth(float width, float height) {
  return moulding(rounded_rectangle({width, width}, 0.008f), open_line({{0.05f, 0, kCrisp},
                                                                        {0.05f, 0.4f * height, 0.006f},
                                                                        {0.02f, 0.5f * height},
                                                                        {0, 0.6f * height, 0.003f},
                                                                        {0, height, 0.008f},
                                                                        {0.0005f - width / 2, height, kCrisp}},
                                                                       16));
}

// A pedestal with a moulded foot and cap; square, `width` wide at the die.
Mesh pedestal(float width, float height) {
  return moulding(rounded_rectangle({width, width}, 0.008f), open_line({{0.07f, 0, kCrisp},
                                                                        {0.07f, 0.09f, 0.006f},
                                                                        {0.055f, 0.10f, 0.003f},
                                                                        {0.05f, 0.13f},
                                                                        {0.02f, 0.15f},
                                                                        {0.012f, 0.17f, 0.003f},
                                                                        {0, 0.18f, 0.003f},
                                                                        {0, height - 0.13f, 0.003f},
                                                                        {0.012f, height - 0.12f, 0.003f},
                                                                        {0.03f, height - 0.085f},
                                                                        {0.055f, height - 0.07f, 0.004f},
                                                                        {0.055f, height - 0.015f, 0.004f},
                                                                        {0.04f, height, 0.006f},
                                                                        {0.0005f - width / 2, height, kCrisp}},
                                                                       30));
}

// The floor under the near window: low things, so that each has its sun.
void show_foreground(Showcase& s) {
  const Detail d = s.detail();
  s.show("amphora", amphora(d), at(-3.45f, 0.25f, 3.45f, 60), metal::kBrass, 0.14f);
  s.show("coil spring", coil_spring(d), at(-3.2f, 0, 1.45f), metal::kSteel, 0.22f);
  s.show("bowl", resting(bowl(d), rotate_y(radians(48)) * rotate_z(radians(42))), at(-0.10f, 0, 2.35f), metal::kSilver,
         0.12f);
  s.show("wedding ring", finger_ring(d), at(-1.70f, 0, 2.62f), metal::kGold, 0.08f);
  s.show("fallen pawn", resting(chess_pawn(d), rotate_y(radians(150)) * rotate_z(radians(-80))), at(0.42f, 0, 3.85f),
         metal::kBronze, 0.135f);
}

constexpr float kTableX = 1.95f, kTableZ = 3.15f, kTableTop = 0.805f;

void show_table(Showcase& s) {
  const Detail d = s.detail();
  const Affine table = at(kTableX, 0, kTableZ);
  s.show("gold cloth", table_cloth(0.80f, 0.80f, d), table, metal::kNickel, 0.42f);
  s.show("crown", crown(d), table * at(0.42f, kTableTop + 0.105f, -0.08f, 10), metal::kGold, 0.11f);
  s.show("kettle", kettle(d), table * at(-0.40f, kTableTop, -0.16f, 195), metal::kCopper, 0.13f);
  s.show("tall goblet", goblet(d), table * at(0.05f, kTableTop, 0.02f), metal::kSilver, 0.09f);
  s.show("goblet", resting(goblet(d), rotate_y(radians(-35)) * rotate_z(radians(-96))),
         table * at(-0.34f, kTableTop, 0.52f), metal::kGold, 0.15f);
}

void show_chess(Showcase& s) {
  const Detail d = s.detail();
  s.show("chess king", chess_king(d), at(0.05f, 0, -2.05f, 15), metal::kGold, 0.115f);
  s.show("chess queen", chess_queen(d), at(-0.85f, 0, -2.35f), metal::kPlatinum, 0.105f);
  s.show("chess bishop", chess_bishop(d), at(-0.45f, 0, -1.40f), metal::kNickel, 0.19f);
  s.show("chess rook", chess_rook(d), at(-1.75f, 0, -1.95f), metal::kBronze, 0.21f);
  s.show("chess pawn", chess_pawn(d), at(-1.25f, 0, -1.15f), metal::kAluminium, 0.16f);
}

void show_barrier(Showcase& s) {
  const Detail d = s.detail();
  const Vec3 posts[] = {{1.80f, 0, -2.75f}, {1.75f, 0, -1.30f}, {2.40f, 0, 0.05f}, {3.90f, 0, 0.20f}};
  const Mesh post = lathe(open_line({{0, 0, kCrisp},
                                     {0.16f, 0, 0.006f},
                                     {0.165f, 0.02f, 0.006f},
                                     {0.06f, 0.06f},
                                     {0.024f, 0.10f, 0.004f},
                                     {0.022f, 0.86f, 0.004f},
                                     {0.036f, 0.87f, 0.004f},
                                     {0.036f, 0.90f, 0.004f},
                                     {0.02f, 0.91f, 0.004f},
                                     {0.045f, 0.955f},
                                     {0, 1.0f, kCrisp}},
                                    d.segments(64)),
                          d.segments(48));
  Mesh stanchions, chains;
  for (const Vec3 p : posts) append(stanchions, post, translate(p));
  const Vec3 hook{0, 0.885f, 0};
  for (int k = 0; k < 3; ++k) append(chains, chain(posts[k] + hook, posts[k + 1] + hook, 0.26f, d));
  s.show("stanchions", std::move(stanchions), {}, metal::kBrass, 0.26f);
  s.show("chain", std::move(chains), {}, metal::kNickel, 0.24f);
}

void show_middle(Showcase& s) {
  const Detail d = s.detail();
  show_chess(s);
  show_barrier(s);
  s.show("Klein bottle", klein_bottle(d), at(-3.05f, 0.9f, -2.75f, -20), metal::kTitanium, 0.18f);
  s.show("large gear", gear(28, 0.52f, 0.10f, d), translate({-3.45f, 0.40f, 0.35f}) * rotate_y(radians(48)),
         metal::kSteel, 0.28f);
  s.show("small gear", gear(14, 0.27f, 0.10f, d), translate({-2.97f, 0.40f, -0.18f}) * rotate_y(radians(48)),
         metal::kBronze, 0.32f);
  s.show("trumpet", trumpet(d), translate({0.75f, 0.735f, -0.85f}) * rotate_y(radians(200)) * rotate_x(radians(12)),
         metal::kGold, 0.07f);
  s.show("torus knot", torus_knot(d), at(2.75f, 0.93f, -2.05f, 25), metal::kCopper, 0.10f);
  s.show("mirror dish", mirror_dish(d),
         translate({4.40f, 1.25f, -0.95f}) * rotate_y(radians(25)) * rotate_z(radians(100)), metal::kSilver, 0.065f);
}

void show_far_end(Showcase& s) {
  const Detail d = s.detail();
  s.show("armillary sphere", armillary_sphere(d), at(-2.75f, 0.55f, -6.7f, 20), metal::kBrass, 0.125f);
  s.show("candlestick", candlestick(d), at(-1.95f, 0, -5.9f) * scale({1.7f, 1.7f, 1.7f}), metal::kBrass, 0.17f);
  s.show("bell", bell(d), at(1.7f, 0.40f, -6.3f), metal::kBronze, 0.30f);
  s.show("spiral staircase", spiral_staircase(3.3f, d), at(3.05f, 0, -8.1f, -36), metal::kSteel, 0.38f);
  s.show("letters", letters("LUCIOLE", 0.72f, d), at(-0.6f, 3.72f, 0.12f - kHalfLength), metal::kGold, 0.20f);
}

Mesh round_table(Detail detail) {
  return lathe(open_line({{0.32f, 0, kCrisp},
                          {0.30f, 0.05f},
                          {0.06f, 0.12f},
                          {0.08f, 0.4f},
                          {0.06f, 0.7f, kCrisp},
                          {0.78f, 0.74f, kCrisp},
                          {0.78f, 0.79f, 0.02f},
                          {0, 0.795f, kCrisp}},
                         detail.segments(30)),
               detail.segments(48));
}

// A squarish pillow: a superellipse in plan, pinched towards its rim.
Mesh pillow(Detail detail) {
  return grid_surface({detail.segments(96, 16), detail.segments(48, 8), true, false, {1, 1}}, [](float u, float v) {
    const float angle = kTwoPi * u, c = std::cos(angle), s = std::sin(angle);
    const float ring = v == 0 || v == 1 ? 0 : std::sin(kPi * v);
    const float r =
        0.25f * std::pow(ring, 0.55f) / std::pow(std::pow(std::abs(c), 4.0f) + std::pow(std::abs(s), 4.0f), 0.25f);
    return Vec3{r * c, 0.06f - 0.062f * std::cos(kPi * v), -r * s};
  });
}

void add_furniture(Scene& scene, const HallMaterials& materials, Detail detail) {
  Mesh stone, wood, cushion;
  append(stone, plinth(0.66f, 0.25f), at(-3.45f, 0, 3.45f));
  append(stone, pedestal(0.52f, 0.90f), at(-3.05f, 0, -2.75f, -20));
  append(stone, pedestal(0.56f, 0.93f), at(2.75f, 0, -2.05f, 25));
  append(stone, pedestal(0.60f, 0.55f), at(-2.75f, 0, -6.7f, 20));
  append(wood, pedestal(1.00f, 0.40f), at(-3.25f, 0, 0.12f, 48));
  append(wood, pedestal(0.62f, 0.52f), at(0.72f, 0, -0.85f, 20));
  append(wood, pedestal(0.95f, 0.40f), at(1.7f, 0, -6.3f));
  append(wood, round_table(detail), at(kTableX, 0, kTableZ));
  append(cushion, pillow(detail), at(kTableX + 0.42f, kTableTop, kTableZ - 0.08f, 10));
  append(cushion, rounded_box({0.5f, 0.18f, 0.3f}, 0.06f), at(0.72f, 0.60f, -0.85f, 20));
  scale_uv(stone, kStoneTile);
  scale_uv(wood, kOakTile);
  add_tangents(stone);
  add_tangents(wood);
  add_mesh(scene, "stone pedestals", materials.limestone, std::move(stone));
  add_mesh(scene, "oak pedestals", materials.oak, std::move(wood));
  add_mesh(scene, "cushions", materials.velvet, std::move(cushion));
}

}  // namespace

void add_exhibits(Scene& scene, const HallMaterials& materials, Detail detail) {
  add_furniture(scene, materials, detail);
  Showcase showcase(scene, detail);
  show_foreground(showcase);
  show_table(showcase);
  show_middle(showcase);
  show_far_end(showcase);
}

}  // namespace luciole::workshop::gallery
