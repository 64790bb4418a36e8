// SPDX-License-Identifier: Apache-2.0
#include "real_time/sky_light/sky_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/sky.h"

namespace luciole {
namespace {

Environment uniform_sky(float radiance) {
  Environment sky;
  sky.radiance = Vec3(1, 1, 1);
  sky.width = 32, sky.height = 16;
  sky.pixels.assign(std::size_t(sky.width) * sky.height, Vec3(radiance, radiance, radiance));
  return sky;
}

// Irradiance of a floor that looks up, by frames of jittered directions: mean and standard error.
std::array<double, 2> floor_irradiance(const Environment& sky, int frames) {
  double sum = 0, squares = 0;
  for (int i = 0; i < frames; ++i) {
    double irradiance = 0;
    for (const PunctualLight& light : sample_sky(sky, {.frame = static_cast<std::uint64_t>(i), .jitter = true}))
      irradiance += light.intensity.x * std::max(-light.direction.y, 0.0f);
    sum += irradiance, squares += irradiance * irradiance;
  }
  const double mean = sum / frames;
  return {mean, std::sqrt(std::max(squares / frames - mean * mean, 0.0) / frames)};
}

TEST(SkyLight, of_a_uniform_sky_lights_a_floor_with_pi_times_its_radiance) {
  const auto [mean, error] = floor_irradiance(uniform_sky(2), 4000);
  EXPECT_LT(std::abs(mean - 2 * M_PI), 4 * error + 1e-4);
  // Forgetting that texels near the poles are small would give 2 pi / 2 * mean |cos| over the rectangle: 4 instead.
  EXPECT_GT(std::abs(mean - 4.0), 20 * error);
}

TEST(SkyLight, finds_a_small_bright_sun_and_its_power) {
  Environment sky = uniform_sky(0.01f);
  sky.pixels[std::size_t(3) * sky.width + 20] = Vec3(5000, 4000, 3000);
  const PrimaryLights lights = sample_sky(sky, {});
  ASSERT_EQ(lights.size(), 16u);
  int from_sun = 0;
  for (const PunctualLight& light : lights) from_sun += light.intensity.x > 1.5f * light.intensity.z;
  EXPECT_GE(from_sun, 15);
}

TEST(SkyLight, comes_from_where_the_sky_is_seen) {
  Environment sky = uniform_sky(0);
  sky.pixels[std::size_t(5) * sky.width + 9] = Vec3(7, 7, 7);
  for (const PunctualLight& light : sample_sky(sky, {}))
    EXPECT_GT(sky_radiance(sky, -light.direction).x, 1.0f);  // bilinear: bright around the texel only
}

TEST(SkyLight, of_a_constant_or_black_environment_is_none) {
  Environment constant;
  constant.radiance = Vec3(1, 1, 1);
  EXPECT_TRUE(sample_sky(constant, {}).empty());
  EXPECT_TRUE(sample_sky(uniform_sky(0), {}).empty());
}

}  // namespace
}  // namespace luciole
