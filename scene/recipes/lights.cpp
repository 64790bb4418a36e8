// SPDX-License-Identifier: Apache-2.0
// A room with very many punctual lights of all colours; every fifth is a spot that points downwards. All of them
// together shine as strongly however many there are, so that pictures of one series need one exposure.
#include <cmath>

#include "scene/recipes/colonnade.h"
#include "scene/recipes/hash.h"
#include "scene/recipes/recipe_list.h"
#include "scene/recipes/scene_kit.h"

namespace luciole::workshop {
namespace {

constexpr float kTotalIntensity = 240;  // of all lights [W/sr]

// A warm or cool colour whose mean is 1: hue in [0,1).
Vec3 tint(float hue) {
  return {1 + 0.8f * std::cos(kTwoPi * hue), 1 + 0.8f * std::cos(kTwoPi * (hue - 1.0f / 3)),
          1 + 0.8f * std::cos(kTwoPi * (hue - 2.0f / 3))};
}

PunctualLight make_light(std::uint32_t seed, std::uint32_t index, const HallSize& size, float mean_intensity) {
  const auto random = [&](std::uint32_t dimension) { return unit_hash(seed, index, dimension); };
  constexpr float kMargin = 0.15f;
  const Vec3 at{(size.width - 2 * kMargin) * (random(0) - 0.5f), kMargin + (size.height - 2 * kMargin) * random(1),
                (size.length - 2 * kMargin) * (random(2) - 0.5f)};
  // Strengths spread over a factor of nine, mean one: lights are not all alike.
  const Vec3 intensity = tint(random(3)) * (mean_intensity * (0.2f + 1.6f * random(4)));
  const std::string number = std::to_string(index);
  if (index % 5 != 4) return point_light("light " + number, at, intensity);
  const Vec3 below = at + Vec3{random(5) - 0.5f, -1, random(6) - 0.5f};
  return spot_light("spot " + number, {at, below}, intensity * 3, 15, 40);
}

Scene make_lights(const Values& values) {
  const HallSize size;
  const auto count = static_cast<std::uint32_t>(values.at("count"));
  const auto seed = static_cast<std::uint32_t>(values.at("seed"));
  Scene scene;
  add_colonnade(scene, size);
  scene.lights.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    scene.lights.push_back(make_light(seed, i, size, kTotalIntensity / static_cast<float>(count)));
  }
  scene.cameras.push_back(named_camera("hall", {{1.1f, 1.6f, 8.4f}, {-0.3f, 1.35f, 0}}, 52));
  return scene;
}

}  // namespace

Recipe lights_recipe() {
  return {{"lights",
           "a hall of columns with many punctual lights (points and spots)",
           {{"count", "number of lights", 1000, 1, 1048576, true},
            {"seed", "another seed, another arrangement", 1, 0, 4294967295.0, true}}},
          make_lights};
}

}  // namespace luciole::workshop
