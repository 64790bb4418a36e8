// SPDX-License-Identifier: Apache-2.0
#include "offline/light_set/infinite_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/sky.h"

namespace luciole {
namespace {

constexpr double kPi = std::numbers::pi;

// The look-up is bilinear: a texel's weight must not be 0 where a neighbour's light reaches into it.
double brightest_around(const Environment& sky, std::uint32_t row, std::uint32_t column) {
  double brightest = 0;
  for (int down = -1; down <= 1; ++down) {
    for (int across = -1; across <= 1; ++across) {
      const auto r = std::clamp<std::int64_t>(std::int64_t(row) + down, 0, std::int64_t(sky.height) - 1);
      const auto c = (std::int64_t(column) + across + sky.width) % sky.width;
      const double weight = across == 0 && down == 0 ? 1.0 : 0.25;
      brightest =
          std::max(brightest,
                   double(weight) *
                       channel_mean(sky.radiance *
                                    sky.pixels[static_cast<std::size_t>(r) * sky.width + static_cast<std::size_t>(c)]));
    }
  }
  return brightest;
}

}  // namespace

InfiniteLights::InfiniteLights(const Scene& scene) : environment_(&scene.environment) {
  double sun_power = 0, sky_power = 0;
  for (const PunctualLight& light : scene.lights) {
    if (light.kind != PunctualLight::Kind::directional || !(channel_mean(light.intensity) > 0)) continue;
    sun_power += channel_mean(light.intensity);
    suns_.push_back({-light.direction, light.intensity, sun_power});
  }
  for (Sun& sun : suns_) sun.running_share /= sun_power;
  const Environment& sky = *environment_;
  sums_.reserve(sky.pixels.size());
  for (std::uint32_t row = 0; row < sky.height && !sky.pixels.empty(); ++row) {
    const double solid_angle = sky_texel_solid_angle(sky, row);
    for (std::uint32_t column = 0; column < sky.width; ++column) {
      sums_.push_back(sky_power += brightest_around(sky, row, column) * solid_angle);
    }
  }
  if (!(sky_power > 0)) sums_.clear();
  // What reaches a surface that faces up: a sun's irradiance, a quarter of the sphere's radiance.
  sun_share_ = suns_.empty() ? 0 : sums_.empty() ? 1 : sun_power / (sun_power + sky_power / 4);
}

InfiniteLightSample InfiniteLights::sample(double choice, Vec2 place) const {
  InfiniteLightSample sample;
  if (choice < sun_share_) {
    const double u = choice / sun_share_;
    const auto found = std::find_if(suns_.begin(), suns_.end() - 1, [u](const Sun& s) { return u < s.running_share; });
    const double before = found == suns_.begin() ? 0 : (found - 1)->running_share;
    sample.direction = found->to_sun, sample.radiance = found->irradiance, sample.is_sun = true;
    sample.pdf = static_cast<float>(sun_share_ * (found->running_share - before));
    return sample;
  }
  const Environment& sky = *environment_;
  const double wanted = (choice - sun_share_) / (1 - sun_share_) * sums_.back();
  const auto texel = static_cast<std::size_t>(std::upper_bound(sums_.begin(), sums_.end() - 1, wanted) - sums_.begin());
  sample.direction = sky_direction(sky, texel, place.x, place.y);
  sample.radiance = sky_radiance(sky, sample.direction);
  sample.pdf = sky_pdf(sample.direction);
  return sample;
}

float InfiniteLights::sky_pdf(Vec3 direction) const {
  if (sums_.empty()) return 0;
  const Environment& sky = *environment_;
  const double u = 0.5 + std::atan2(double(direction.x), -double(direction.z)) / (2 * kPi);
  const double v = std::acos(std::clamp(double(direction.y), -1.0, 1.0)) / kPi;
  const auto column = std::min(static_cast<std::uint32_t>(u * sky.width), sky.width - 1);
  const auto row = std::min(static_cast<std::uint32_t>(v * sky.height), sky.height - 1);
  const std::size_t texel = std::size_t(row) * sky.width + column;
  const double power = sums_[texel] - (texel > 0 ? sums_[texel - 1] : 0);
  return static_cast<float>((1 - sun_share_) * power / (sums_.back() * sky_texel_solid_angle(sky, row)));
}

}  // namespace luciole
