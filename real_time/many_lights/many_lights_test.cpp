// SPDX-License-Identifier: Apache-2.0
#include "real_time/many_lights/many_lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "real_time/front_test_scene.h"

namespace luciole {
namespace {

using namespace front_test;

constexpr double kSigmas = 4;

PunctualLight light_of(PunctualLight::Kind kind, float x) {
  PunctualLight light;
  light.kind = kind;
  light.position = Vec3(x, 2, 0);
  light.direction = Vec3(0, -1, 0);
  light.intensity = Vec3(3, 2, 1);
  light.cos_inner = 0.9f, light.cos_outer = 0.6f;
  return light;
}

// Radiant intensity as the door of many_lights defines it.
Vec3 door_intensity(const ManyLights& lights, std::size_t i, Vec3 direction) {
  const float c = dot(direction, at(lights.axis, i));
  const float t = std::clamp(std::max(c, -c * lights.two_sided[i]) * lights.scale[i] + lights.offset[i], 0.0f, 1.0f);
  return at(lights.intensity, i) * (lights.squared[i] > 0 ? t * t : t);
}

TEST(ManyLights, are_the_punctual_lights_that_are_neither_primary_nor_directional) {
  Scene scene;
  using Kind = PunctualLight::Kind;
  scene.lights = {light_of(Kind::point, 1), light_of(Kind::spot, 2), light_of(Kind::directional, 3),
                  light_of(Kind::point, 4), light_of(Kind::point, 4)};
  const ManyLights lights = make_many_lights(scene, {scene.lights[0], scene.lights[3]}, Settings{}, 0);
  ASSERT_EQ(lights.size(), 2u);  // the spot, and one of the twins
  EXPECT_EQ(lights.position[0][0], 2);
  EXPECT_EQ(lights.position[0][1], 4);
  EXPECT_EQ(make_many_lights(scene, {}, Settings{}, 0).size(), 4u);
}

TEST(ManyLights, one_formula_gives_points_and_spots_their_intensity) {
  Scene scene;
  scene.lights = {light_of(PunctualLight::Kind::point, 1), light_of(PunctualLight::Kind::spot, 2)};
  const ManyLights lights = make_many_lights(scene, {}, Settings{}, 0);
  for (float angle = 0; angle < 3.1f; angle += 0.05f) {
    const Vec3 direction(std::sin(angle), -std::cos(angle), 0);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(door_intensity(lights, i, direction).x, intensity_towards(scene.lights[i], direction).x, 1e-5f);
    }
  }
}

Scene panel(bool double_sided) {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].emission = Vec3(5, 4, 3);
  scene.materials[0].double_sided = double_sided;
  scene.meshes = {quad({0, 0, 0}, {2, 0, 0}, {0, 1, 0})};  // area 2, faces +z
  return scene;
}

TEST(ManyLights, emissive_triangles_shine_as_lambert_emitters_from_their_front) {
  for (const bool double_sided : {false, true}) {
    const ManyLights lights = make_many_lights(panel(double_sided), {}, Settings{}, 3);
    ASSERT_EQ(lights.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_FLOAT_EQ(lights.area[i], 1);
      EXPECT_FLOAT_EQ(door_intensity(lights, i, Vec3(0, 0, 1)).x, 5);
      EXPECT_NEAR(door_intensity(lights, i, normalize(Vec3(1, 0, 1))).y, 4 * std::sqrt(0.5f), 1e-5f);
      EXPECT_FLOAT_EQ(door_intensity(lights, i, Vec3(0, 0, -1)).x, double_sided ? 5.0f : 0.0f);
    }
  }
}

TEST(ManyLights, unlit_triangles_shine_on_nothing) {
  Scene scene = panel(false);
  scene.materials[0].unlit = true;
  EXPECT_EQ(make_many_lights(scene, {}, Settings{}, 0).size(), 0u);
}

TEST(ManyLights, points_are_uniform_over_the_triangle_and_move_with_seed_and_frame) {
  const Scene scene = panel(false);
  double sum_x = 0, sum_x_sq = 0;
  constexpr int kFrames = 4000;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const ManyLights lights = make_many_lights(scene, {}, Settings{}, frame);
    const auto x = static_cast<double>(lights.position[0][0]);  // the triangle (0,0) (2,0) (2,1): mean 4/3
    sum_x += x, sum_x_sq += x * x;
    ASSERT_LE(lights.position[1][0], lights.position[0][0] / 2 + 1e-6f);
  }
  const double mean = sum_x / kFrames, sigma = std::sqrt((sum_x_sq / kFrames - mean * mean) / kFrames);
  EXPECT_LT(std::abs(mean - 4.0 / 3), kSigmas * sigma);
  EXPECT_GT(std::abs(mean - 1.0), 10 * sigma);  // the control: without the square root the mean would be 1
  Settings reseeded;
  reseeded.seed = 2;
  EXPECT_NE(make_many_lights(scene, {}, reseeded, 0).position[0][0],
            make_many_lights(scene, {}, Settings{}, 0).position[0][0]);
}

// A texture whose left half is dark: half of the drawn points of a square shine, and the mean is the panel's power.
TEST(ManyLights, textured_emission_is_taken_at_the_point_and_dark_ones_keep_their_key) {
  Scene scene = panel(false);
  auto image = std::make_shared<MipImage>();
  image->levels = {{2, 1, 0}};
  image->rgba = {0, 0, 0, 255, 255, 255, 255, 255};
  Texture texture;
  texture.image = image;
  texture.magnify_linear = texture.minify_linear = false;
  scene.textures = {texture};
  scene.materials[0].emissive_texture.texture = 0;
  double lit = 0;
  constexpr int kFrames = 2000;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const ManyLights lights = make_many_lights(scene, {}, Settings{}, frame);
    lit += static_cast<double>(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
      ASSERT_GE(lights.position[0][i], 1 - 1e-5f);
      ASSERT_EQ(lights.key[i], lights.position[1][i] > lights.position[0][i] / 2 ? 1u : 0u);
    }
  }
  // Of the two triangles' points 3/4 and 1/4 fall into the right half.
  const double sigma = std::sqrt(2 * 0.1875 / kFrames);
  EXPECT_LT(std::abs(lit / kFrames - 1), kSigmas * sigma);
}

TEST(ManyLights, same_bits_for_one_and_two_threads) {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].emission = Vec3(1, 1, 1);
  scene.meshes = {ball({0, 0, 0}, 1, 100)};
  const auto hash = [&](int threads, std::uint64_t frame) {
    ManyLights lights;
    with_threads(threads, [&] { lights = make_many_lights(scene, {}, Settings{}, frame); });
    PlaneHash sum;
    sum.add(lights.position), sum.add(lights.intensity), sum.add(lights.key);
    return sum.value();
  };
  EXPECT_EQ(hash(1, 0), hash(2, 0));
  EXPECT_NE(hash(1, 0), hash(1, 1));
}

}  // namespace
}  // namespace luciole
