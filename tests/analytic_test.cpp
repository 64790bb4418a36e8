// SPDX-License-Identifier: Apache-2.0
// A scene whose light is known in closed form: a white sphere seen from inside, lit by a point light at its centre. Any
// two points of a sphere exchange cos cos / l^2 = 1 / (4 R^2), so that every virtual point light gives every pixel the
// same: with albedo a and intensity I the direct radiance is a I / (pi R^2), and that after one bounce a^2 I / (pi
// R^2).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "real_time/frame.h"

namespace luciole {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kRadius = 2.5f, kAlbedo = 0.6f, kIntensity = 7.0f;
constexpr std::uint32_t kSlices = 256, kStacks = 128;
// A chord of the tessellation lies nearer to the centre than the sphere, by this part of the radius at most; radiance
// goes with its square, twice for two surfaces.
const float kFlatness = 1 - std::cos(kPi / kSlices) * std::cos(0.5f * kPi / kStacks);
const float kTolerance = 4 * kFlatness + 1e-4f;  // and the rounding of 4,096 additions

std::shared_ptr<Scene> white_sphere() {
  auto scene = std::make_shared<Scene>();
  Material white;
  white.base_colour = {kAlbedo, kAlbedo, kAlbedo, 1};
  white.metallic = 0;
  white.dielectric_f0 = {0, 0, 0};  // Lambert
  white.dielectric_f90 = 0;
  white.double_sided = true;
  scene->materials = {white};
  Mesh mesh;
  for (std::uint32_t j = 0; j <= kStacks; ++j) {
    for (std::uint32_t i = 0; i <= kSlices; ++i) {
      const float azimuth = 2 * kPi * static_cast<float>(i) / kSlices, polar = kPi * static_cast<float>(j) / kStacks;
      const Vec3 out(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
      mesh.positions.push_back(out * kRadius);
      mesh.normals.push_back(-out);
    }
  }
  for (std::uint32_t j = 0; j < kStacks; ++j) {
    for (std::uint32_t i = 0; i < kSlices; ++i) {
      const std::uint32_t a = j * (kSlices + 1) + i, b = a + kSlices + 1;
      for (const std::uint32_t index : {a, a + 1, b, b, a + 1, b + 1}) mesh.indices.push_back(index);
    }
  }
  scene->meshes = {std::move(mesh)};
  PunctualLight light;
  light.intensity = {kIntensity, kIntensity, kIntensity};
  scene->lights = {light};
  return scene;
}

Frame sphere_frame(Ranges ranges, std::uint32_t interleave) {
  const std::shared_ptr<Scene> scene = white_sphere();
  Settings settings;
  settings.width = 40, settings.height = 24;
  settings.vpls = 4096;
  settings.vpl_seed = 1;  // no ray goes exactly through a pole, where triangles have no area
  settings.ranges = ranges;
  settings.delta = 30;  // a large error, so that clamped ranges end inside the sphere
  settings.interleave = interleave;
  settings.near_field = NearField::point;
  settings.filter = Filter::none;
  Result<Renderer> renderer =
      Renderer::create(scene, look_at(Vec3(0.3f, -0.2f, 0.4f), Vec3(1, 0.5f, -1), 1.2f), scene->lights, settings);
  EXPECT_TRUE(renderer.has_value());
  return std::move(*renderer->render(0, {"direct", "unfiltered"}));
}

void expect_everywhere(const Frame& frame, const std::string& layer, float expected) {
  for (const Vec3& pixel : frame.layers.colours(layer)) {
    EXPECT_NEAR(pixel.x / expected, 1, kTolerance);
    EXPECT_NEAR(pixel.y / expected, 1, kTolerance);
    EXPECT_NEAR(pixel.z / expected, 1, kTolerance);
  }
}

const float kDirect = kAlbedo * kIntensity / (kPi * kRadius * kRadius);

TEST(WhiteSphere, shows_its_direct_light_in_closed_form) {
  expect_everywhere(sphere_frame(Ranges::infinite, 1), "direct", kDirect);
}

TEST(WhiteSphere, shows_one_bounce_in_closed_form) {
  expect_everywhere(sphere_frame(Ranges::infinite, 1), "unfiltered", kAlbedo * kDirect);
}

double mean_indirect(const Frame& frame) {
  double sum = 0;
  const std::vector<Vec3> light = frame.layers.colours("unfiltered");
  for (const Vec3& pixel : light) sum += pixel.x;
  return sum / static_cast<double>(light.size());
}

// All lights are alike here: a 64th of them, times 64, is the same light. Only in the mean, as a pixel does not see the
// light on its own flat triangle, which is one of 4,096 without interleaving, and one of 64 with it.
TEST(WhiteSphere, shows_the_same_with_interleaving) {
  EXPECT_NEAR(mean_indirect(sphere_frame(Ranges::infinite, 8)) / (kAlbedo * kDirect), 1, kTolerance);
}

TEST(WhiteSphere, is_too_dark_with_clamped_ranges) {
  EXPECT_LT(mean_indirect(sphere_frame(Ranges::clamped_bound, 1)), (1 - 10 * kTolerance) * kAlbedo * kDirect);
}

}  // namespace
}  // namespace luciole
