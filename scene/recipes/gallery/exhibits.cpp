// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/gallery/exhibits.h"

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

// A pedestal with a moulded foot and cap; square, `width` wide at the die.
Mesh pedestal(float width, float height) {
  return moulding(rounded_rectangle({width, width}, 0.008f),
                  open_line({{0.07f, 0, kCrisp}, {0.07f, 0.09f, 0.006f}, {0.055f, 0.10f, 0.003f}, {0.05f, 0.13f},
                             {0.02f, 0.15f}, {0.012f, 0.17f, 0.003f}, {0, 0.18f, 0.003f}, {0, height - 0.13f, 0.003f},
                             {0.012f, height - 0.12f, 0.003f}, {0.03f, height - 0.085f}, {0.055f, height - 0.07f, 0.004f},
                             {0.055f, height - 0.015f, 0.004f}, {0.04f, height, 0.006f}, {0.0005f - width / 2, height, kCrisp}},
                            30));
}

void show_foreground(Showcase& s) {
  const Detail d = s.detail();
  s.show("wedding ring", finger_ring(d), at(0.55f, 0, 4.35f), metal::kGold, 0.06f);
  s.show("bowl", bowl(d), translate({-0.75f, 0.12f, 4.05f}) * rotate_y(radians(24)) * rotate_z(radians(38)),
         metal::kSilver, 0.08f);
  s.show("fallen pawn", chess_pawn(d), translate({1.75f, 0.157f, 4.75f}) * rotate_y(radians(145)) * rotate_z(radians(-90)),
         metal::kBronze, 0.135f);
  s.show("crown", crown(d), at(2.62f, 1.13f, 3.95f, 10), metal::kGold, 0.095f);
  s.show("coil spring", coil_spring(d), at(1.35f, 0, 2.35f), metal::kSteel, 0.22f);
}

void show_table(Showcase& s) {
  const Detail d = s.detail();
  const Affine table = at(-2.35f, 0, 2.95f);
  s.show("gold cloth", table_cloth(0.66f, 0.80f, d), table, metal::kGold, 0.45f);
  s.show("kettle", kettle(d), table * at(0.08f, 0.805f, -0.12f, 205), metal::kCopper, 0.11f);
  s.show("tall goblet", goblet(d), table * at(0.36f, 0.805f, 0.26f), metal::kSilver, 0.07f);
  s.show("goblet", goblet(d), table * at(-0.05f, 0.805f, 0.40f) * scale({0.86f, 0.86f, 0.86f}), metal::kGold, 0.15f);
  s.show("candlestick", candlestick(d), table * at(-0.33f, 0.805f, 0.02f), metal::kBrass, 0.17f);
}

void show_chess(Showcase& s) {
  const Detail d = s.detail();
  s.show("chess king", chess_king(d), at(0.15f, 0, -0.55f, 15), metal::kGold, 0.12f);
  s.show("chess queen", chess_queen(d), at(-0.72f, 0, -1.05f), metal::kPlatinum, 0.105f);
  s.show("chess bishop", chess_bishop(d), at(0.78f, 0, -0.15f), metal::kNickel, 0.19f);
  s.show("chess rook", chess_rook(d), at(-1.5f, 0, -0.75f), metal::kBronze, 0.21f);
  s.show("chess pawn", chess_pawn(d), at(-0.35f, 0, 0.12f), metal::kAluminium, 0.16f);
}

void show_right_side(Showcase& s) {
  const Detail d = s.detail();
  s.show("torus knot", torus_knot(d), at(2.6f, 0.93f, -0.35f, 25), metal::kCopper, 0.085f);
  s.show("mirror dish", mirror_dish(d), translate({4.12f, 0.60f, 0.95f}) * rotate_z(radians(62)) * rotate_x(radians(8)),
         metal::kSilver, 0.05f);
  s.show("amphora", amphora(d), at(3.45f, 0.25f, 2.55f, 60), metal::kBrass, 0.14f);
  const Vec3 posts[] = {{1.75f, 0, -0.95f}, {1.72f, 0, 0.55f}, {2.55f, 0, 1.75f}, {3.9f, 0, 1.85f}};
  Mesh stanchions, chains;
  const Mesh post = lathe(open_line({{0, 0, kCrisp}, {0.16f, 0, 0.006f}, {0.165f, 0.02f, 0.006f}, {0.06f, 0.06f},
                                     {0.024f, 0.10f, 0.004f}, {0.022f, 0.86f, 0.004f}, {0.036f, 0.87f, 0.004f},
                                     {0.036f, 0.90f, 0.004f}, {0.02f, 0.91f, 0.004f}, {0.045f, 0.955f}, {0, 1.0f, kCrisp}},
                                    d.segments(64)),
                          d.segments(64));
  for (const Vec3 p : posts) append(stanchions, post, translate(p));
  for (int k = 0; k < 3; ++k) append(chains, chain(posts[k] + Vec3{0, 0.885f, 0}, posts[k + 1] + Vec3{0, 0.885f, 0}, 0.26f, d));
  s.show("stanchions", std::move(stanchions), {}, metal::kBrass, 0.26f);
  s.show("chain", std::move(chains), {}, metal::kNickel, 0.24f);
}

void show_left_side_and_end(Showcase& s) {
  const Detail d = s.detail();
  s.show("armillary sphere", armillary_sphere(d), at(-3.2f, 0.55f, -1.75f, 20), metal::kBrass, 0.125f);
  s.show("large gear", gear(28, 0.52f, 0.10f, d), translate({-1.35f, 0.40f, 1.05f}) * rotate_y(radians(28)), metal::kSteel, 0.28f);
  s.show("small gear", gear(14, 0.27f, 0.10f, d), translate({-0.72f, 0.40f, 0.72f}) * rotate_y(radians(28)), metal::kBronze, 0.32f);
  s.show("trumpet", trumpet(d), translate({0.75f, 0.70f, 1.05f}) * rotate_y(radians(200)) * rotate_x(radians(12)), metal::kGold, 0.075f);
  s.show("Klein bottle", klein_bottle(d), at(-2.9f, 0.9f, -6.1f, -20), metal::kTitanium, 0.18f);
  s.show("bell", bell(d), at(1.9f, 0.40f, -4.75f), metal::kBronze, 0.30f);
  s.show("spiral staircase", spiral_staircase(3.3f, d), at(3.05f, 0, -7.9f, -60), metal::kSteel, 0.38f);
  s.show("letters", letters("LUCIOLE", 0.72f, d), at(-0.6f, 3.72f, 0.12f - kHalfLength), metal::kGold, 0.20f);
}

void add_furniture(Scene& scene, const HallMaterials& materials, Detail detail) {
  Mesh stone, wood, cushion;
  append(stone, pedestal(0.46f, 1.02f), at(2.62f, 0, 3.95f, 10));
  append(stone, pedestal(0.56f, 0.93f), at(2.6f, 0, -0.35f, 25));
  append(stone, pedestal(0.60f, 0.55f), at(-3.2f, 0, -1.75f, 20));
  append(stone, pedestal(0.52f, 0.90f), at(-2.9f, 0, -6.1f, -20));
  append(stone, pedestal(0.62f, 0.25f), at(3.45f, 0, 2.55f));
  append(wood, pedestal(0.80f, 0.40f), at(-1.1f, 0, 0.92f, 28));
  append(wood, pedestal(0.62f, 0.52f), at(0.72f, 0, 1.05f, 20));
  append(wood, pedestal(0.95f, 0.40f), at(1.9f, 0, -4.75f));
  append(wood, lathe(open_line({{0.32f, 0, kCrisp}, {0.30f, 0.05f}, {0.06f, 0.12f}, {0.08f, 0.4f}, {0.06f, 0.7f, kCrisp},
                                {0.64f, 0.74f, kCrisp}, {0.64f, 0.79f, 0.02f}, {0, 0.795f, kCrisp}}, 30), 48),
         at(-2.35f, 0, 2.95f));
  append(cushion, grid_surface({detail.segments(96, 16), detail.segments(48, 8), true, false, {1, 1}}, [](float u, float v) {
           // A squarish pillow: a superellipse in plan, pinched towards its rim.
           const float a = kTwoPi * u, c = std::cos(a), s = std::sin(a), ring = v == 0 || v == 1 ? 0 : std::sin(kPi * v);
           const float r = 0.25f * std::pow(ring, 0.55f) / std::pow(std::pow(std::abs(c), 4.0f) + std::pow(std::abs(s), 4.0f), 0.25f);
           return Vec3{r * c, 0.06f - 0.062f * std::cos(kPi * v), -r * s};
         }), at(2.62f, 1.02f, 3.95f, 10));
  append(cushion, rounded_box({0.5f, 0.18f, 0.3f}, 0.06f), at(0.72f, 0.60f, 1.05f, 20));
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
  show_chess(showcase);
  show_right_side(showcase);
  show_left_side_and_end(showcase);
}

}  // namespace luciole::workshop::gallery
