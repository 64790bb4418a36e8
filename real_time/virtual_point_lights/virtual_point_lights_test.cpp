// SPDX-License-Identifier: Apache-2.0
#include "real_time/virtual_point_lights/virtual_point_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "base/parallel.h"
#include "real_time/front_test_scene.h"

namespace luciole {
namespace {

using namespace front_test;

constexpr double kSigmas = 4;

PunctualLight lamp(PunctualLight::Kind kind) {
  PunctualLight light;
  light.kind = kind;
  light.position = Vec3(-0.8f, 2.2f, 0.9f);
  light.direction = normalize(Vec3(0.2f, -1, -0.3f));
  light.intensity = Vec3(4, 3, 2);
  light.cos_inner = 0.9f, light.cos_outer = 0.7f;
  return light;
}

Settings settings_with(std::uint32_t vpls, std::uint64_t vpl_seed = 0, bool jitter = false) {
  Settings settings;
  settings.vpls = vpls, settings.vpl_seed = vpl_seed, settings.jitter = jitter;
  return settings;
}

double sum(const Plane& plane) {
  double total = 0;
  for (const float value : plane) total += static_cast<double>(value);
  return total;
}

TEST(VirtualPointLights, there_are_as_many_as_asked_where_every_photon_meets_a_surface) {
  const RayScene rays = traceable(room_with_ball());
  const PrimaryLights lights = {lamp(PunctualLight::Kind::point), lamp(PunctualLight::Kind::spot)};
  for (const std::uint32_t n : {1u, 2u, 3u, 7u, 64u, 1000u, 65536u}) {
    const VirtualPointLights vpls = make_virtual_point_lights(rays, lights, settings_with(n), 0);
    ASSERT_EQ(vpls.size(), n);
    for (std::uint32_t i = 0; i < n; ++i) ASSERT_EQ(vpls.key[i], i);
  }
}

TEST(VirtualPointLights, stand_on_surfaces_and_look_back_at_the_light) {
  const RayScene rays = traceable(room_with_ball());
  const PunctualLight light = lamp(PunctualLight::Kind::point);
  const VirtualPointLights vpls = make_virtual_point_lights(rays, {light}, settings_with(4096), 0);
  for (std::size_t i = 0; i < vpls.size(); ++i) {
    const Vec3 to_light = light.position - at(vpls.position, i);
    EXPECT_LT(length(normalize(to_light) - at(vpls.incident, i)), 1e-4f);
    EXPECT_GT(dot(at(vpls.incident, i), at(vpls.normal, i)), 0);
    EXPECT_GT(dot(at(vpls.incident, i), at(vpls.geometric_normal, i)), 0);
    EXPECT_NEAR(vpls.flux[0][i], 4 * 4 * std::numbers::pi / 4096, 1e-6);
    const float cosine = dot(at(vpls.incident, i), at(vpls.geometric_normal, i));
    const float area = float(4 * std::numbers::pi / 4096) * dot(to_light, to_light) / cosine;
    EXPECT_NEAR(vpls.area[i] / area, 1, 2e-3);
  }
}

// The areas of all texels tile what the light sees: from inside a sphere, all of it. Without 1/cos they would not.
TEST(VirtualPointLights, areas_add_up_to_the_surface_that_the_light_sees) {
  auto scene = std::make_shared<Scene>();
  scene->materials.resize(1);
  scene->meshes = {ball({0, 0, 0}, 2, 64)};
  const RayScene rays = traceable(scene);
  PunctualLight light = lamp(PunctualLight::Kind::point);
  light.position = Vec3(0.9f, 0.5f, -0.6f);
  const VirtualPointLights vpls = make_virtual_point_lights(rays, {light}, settings_with(65536), 0);
  ASSERT_GT(vpls.size(), 65000u);  // a photon that leaves through a seam of the ball is lost
  const double surface = 16 * std::numbers::pi;
  EXPECT_NEAR(sum(vpls.area) / surface, 1, 0.01);
  double without_cosine = 0;
  for (std::size_t i = 0; i < vpls.size(); ++i) {
    const double cosine = static_cast<double>(dot(at(vpls.incident, i), at(vpls.geometric_normal, i)));
    without_cosine += static_cast<double>(vpls.area[i]) * cosine;
  }
  EXPECT_LT(without_cosine / surface, 0.95);
}

// A sun over a floor: the flux that arrives is irradiance times the floor's projected area.
TEST(VirtualPointLights, jittered_flux_of_a_sun_averages_to_what_the_floor_receives) {
  auto scene = std::make_shared<Scene>();
  scene->materials.resize(1);
  scene->meshes = {quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), quad({-3.2f, 5, 1.7f}, {0.4f, 0, 0}, {0, 0, -0.4f})};
  const RayScene rays = traceable(scene);
  PunctualLight sun = lamp(PunctualLight::Kind::directional);
  sun.direction = normalize(Vec3(0.6f, -1, -0.3f));
  // The small square's shadow falls on the floor: together they receive what the floor alone would.
  const double expected = 4 * 16 * static_cast<double>(-sun.direction.y);
  double total = 0, total_sq = 0;
  constexpr int kFrames = 400;
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto vpls =
        make_virtual_point_lights(rays, {sun}, settings_with(100, 0, true), static_cast<std::uint64_t>(frame));
    const double flux = sum(vpls.flux[0]);
    total += flux, total_sq += flux * flux;
  }
  const double mean = total / kFrames, sigma = std::sqrt((total_sq / kFrames - mean * mean) / kFrames);
  EXPECT_LT(std::abs(mean - expected), kSigmas * sigma);
  EXPECT_GT(std::abs(mean * 0.97 - expected), kSigmas * sigma);  // the control: 3 % less would be noticed
}

TEST(VirtualPointLights, those_without_surface_are_dropped_and_the_others_keep_order_and_key) {
  auto scene = std::make_shared<Scene>();
  scene->materials.resize(1);
  scene->meshes = {quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4})};
  const RayScene rays = traceable(scene);
  const VirtualPointLights vpls =
      make_virtual_point_lights(rays, {lamp(PunctualLight::Kind::point)}, settings_with(10000), 0);
  EXPECT_LT(vpls.size(), 5000u);
  EXPECT_GT(vpls.size(), 500u);
  for (std::size_t i = 1; i < vpls.size(); ++i) ASSERT_LT(vpls.key[i - 1], vpls.key[i]);
  EXPECT_GT(vpls.key.back(), vpls.size());
}

TEST(VirtualPointLights, are_none_without_light_or_scene) {
  const RayScene rays = traceable(room_with_ball());
  EXPECT_EQ(make_virtual_point_lights(rays, {}, settings_with(100), 0).size(), 0u);
  PunctualLight dark = lamp(PunctualLight::Kind::spot);
  dark.intensity = Vec3(0, 0, 0);
  EXPECT_EQ(make_virtual_point_lights(rays, {dark}, settings_with(100), 0).size(), 0u);
  const RayScene nothing = traceable(std::make_shared<Scene>());
  EXPECT_EQ(make_virtual_point_lights(nothing, {lamp(PunctualLight::Kind::directional)}, settings_with(100), 0).size(),
            0u);
}

std::uint64_t hash_of(int threads, const Settings& settings, std::uint64_t frame) {
  VirtualPointLights vpls;
  with_threads(threads, [&] {
    const RayScene rays = traceable(room_with_ball());
    vpls = make_virtual_point_lights(rays, {lamp(PunctualLight::Kind::spot), lamp(PunctualLight::Kind::point)},
                                     settings, frame);
  });
  PlaneHash hash;
  for (const Plane3* planes : {&vpls.position, &vpls.normal, &vpls.incident, &vpls.flux, &vpls.f0}) hash.add(*planes);
  hash.add(vpls.area), hash.add(vpls.key);
  return hash.value();
}

TEST(VirtualPointLights, same_bits_for_one_and_two_threads_and_moved_only_by_what_should_move_them) {
  const std::uint64_t centres = hash_of(1, settings_with(20000), 0);
  EXPECT_EQ(centres, hash_of(2, settings_with(20000), 0));
  EXPECT_EQ(centres, hash_of(1, settings_with(20000), 5));     // frames do not move them
  EXPECT_NE(centres, hash_of(1, settings_with(20000, 3), 0));  // the VPL seed does
  EXPECT_EQ(hash_of(1, settings_with(20000, 3), 0), hash_of(2, settings_with(20000, 3), 9));
  EXPECT_NE(hash_of(1, settings_with(20000, 0, true), 0), hash_of(1, settings_with(20000, 0, true), 1));
  Settings reseeded = settings_with(20000);
  reseeded.seed = 77;
  EXPECT_EQ(centres, hash_of(1, reseeded, 0));  // --seed moves ranges and interleaving only
}

}  // namespace
}  // namespace luciole
