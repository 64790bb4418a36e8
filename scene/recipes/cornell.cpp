// SPDX-License-Identifier: Apache-2.0
// The classic box in the proportions of the measured one, two metres wide: white floor, ceiling and back, a red and a
// green side, a short and a tall block. A spot under the ceiling shines downwards as a ceiling panel would.
#include "scene/recipes/cornell_motion.h"
#include "scene/recipes/metals.h"
#include "scene/recipes/recipe_list.h"
#include "scene/recipes/scene_kit.h"

namespace luciole::workshop {
namespace {

constexpr float kSide = 2;  // [m]
const Vec3 kWhite{0.725f, 0.71f, 0.68f}, kRed{0.63f, 0.065f, 0.05f}, kGreen{0.14f, 0.45f, 0.091f};

// The room is x in [-1,1], y in [0,2], z in [-1,1], open towards +z; all walls face inwards.
void add_room(Scene& scene) {
  const auto white = add_material(scene, matte_material("white", kWhite));
  const auto red = add_material(scene, matte_material("red", kRed));
  const auto green = add_material(scene, matte_material("green", kGreen));
  const float h = kSide / 2;
  add_mesh(scene, "floor", white, rectangle({-h, 0, h}, {kSide, 0, 0}, {0, 0, -kSide}));
  add_mesh(scene, "ceiling", white, rectangle({-h, kSide, -h}, {kSide, 0, 0}, {0, 0, kSide}));
  add_mesh(scene, "back", white, rectangle({-h, 0, -h}, {kSide, 0, 0}, {0, kSide, 0}));
  add_mesh(scene, "left", red, rectangle({-h, 0, h}, {0, 0, -kSide}, {0, kSide, 0}));
  add_mesh(scene, "right", green, rectangle({h, 0, -h}, {0, 0, kSide}, {0, kSide, 0}));
}

// Returns the short block's number.
std::uint32_t add_blocks(Scene& scene, float glossy, bool moves) {
  const auto block = add_material(scene, matte_material("block", kWhite));
  const auto tall = glossy > 0 ? add_material(scene, metal_material("tall block", metal::kCopper, glossy)) : block;
  constexpr float kBevel = 0.004f;
  const Affine where = moves ? Affine{} : translate({0.33f, 0.3f, 0.36f}) * rotate_y(radians(-17));
  const auto number = static_cast<std::uint32_t>(scene.meshes.size());
  add_mesh(scene, "short block", block, placed(rounded_box({0.6f, 0.6f, 0.6f}, kBevel), where));
  add_mesh(scene, "tall block", tall,
           placed(rounded_box({0.6f, 1.2f, 0.6f}, kBevel), translate({-0.34f, 0.6f, -0.28f}) * rotate_y(radians(19))));
  return number;
}

Scene make_cornell(const Values& values) {
  Scene scene;
  add_room(scene);
  const bool moves = values.at("motion") > 0;
  const std::uint32_t block = add_blocks(scene, static_cast<float>(values.at("glossy")), moves);
  const float panel = static_cast<float>(values.at("panel"));
  if (panel > 0) {
    Material glow = matte_material("panel", {0.78f, 0.78f, 0.78f});
    glow.emission = Vec3{1, 0.85f, 0.6f} * panel;
    add_mesh(scene, "panel", add_material(scene, glow),
             rectangle({-0.23f, kSide - 0.004f, -0.19f}, {0.46f, 0, 0}, {0, 0, 0.38f}));
  }
  const Vec3 under_ceiling{0, kSide - 0.02f, 0};
  scene.lights.push_back(spot_light("ceiling spot", {under_ceiling, {0, 0, 0}}, {4, 3.6f, 3}, 60, 88));
  scene.cameras.push_back(named_camera("front", {{0, 1, 3.9f}, {0, 1, 0}}, 39));
  if (moves) set_in_motion(scene, block);
  return scene;
}

}  // namespace

Recipe cornell_recipe() {
  return {{"cornell",
           "the classic box with two blocks under one spot",
           {{"glossy", "GGX alpha of the tall block, which then is copper; 0: matte", 0, 0, 1},
            {"panel", "radiance of an emissive ceiling panel [W/(m^2 sr)]; 0: none", 0, 0, 1e6},
            {"motion", "1: the short block turns, the spot swings and a second camera comes nearer, for 8 s", 0, 0, 1,
             true}}},
          make_cornell};
}

}  // namespace luciole::workshop
