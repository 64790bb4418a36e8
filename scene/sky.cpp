// SPDX-License-Identifier: Apache-2.0
#include "scene/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luciole {

Vec3 sky_radiance(const Environment& environment, Vec3 direction) {
  if (environment.pixels.empty()) return environment.radiance;
  constexpr float kPi = std::numbers::pi_v<float>;
  const auto width = static_cast<std::int32_t>(environment.width);
  const auto height = static_cast<std::int32_t>(environment.height);
  // Azimuth from -Z, growing to the right; polar angle from +Y. Texel centres lie at +0.5.
  const float u = 0.5f + std::atan2(direction.x, -direction.z) / (2 * kPi);
  const float v = std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / kPi;
  const float x = u * static_cast<float>(width) - 0.5f, y = v * static_cast<float>(height) - 0.5f;
  const auto column = static_cast<std::int32_t>(std::floor(x)), row = static_cast<std::int32_t>(std::floor(y));
  const float across = x - static_cast<float>(column), down = y - static_cast<float>(row);
  const auto pixel = [&](std::int32_t i, std::int32_t j) {
    const std::int32_t wrapped = (i % width + width) % width, clamped = std::clamp(j, 0, height - 1);
    return environment
        .pixels[static_cast<std::size_t>(clamped) * environment.width + static_cast<std::size_t>(wrapped)];
  };
  const Vec3 above = pixel(column, row) * (1 - across) + pixel(column + 1, row) * across;
  const Vec3 below = pixel(column, row + 1) * (1 - across) + pixel(column + 1, row + 1) * across;
  return environment.radiance * (above * (1 - down) + below * down);
}

double sky_texel_solid_angle(const Environment& environment, std::uint32_t row) {
  constexpr double kPi = std::numbers::pi;
  const double top = kPi * row / environment.height, bottom = kPi * (row + 1) / environment.height;
  return 2 * kPi / environment.width * (std::cos(top) - std::cos(bottom));
}

Vec3 sky_direction(const Environment& environment, std::size_t texel, double across, double down) {
  constexpr double kPi = std::numbers::pi;
  const auto row = static_cast<std::uint32_t>(texel / environment.width);
  const auto column = static_cast<std::uint32_t>(texel % environment.width);
  const double azimuth = 2 * kPi * ((column + across) / environment.width - 0.5);
  const double cos_top = std::cos(kPi * row / environment.height);
  const double cos_bottom = std::cos(kPi * (row + 1) / environment.height);
  const double y = cos_top + (cos_bottom - cos_top) * down;
  const double level = std::sqrt(std::max(1 - y * y, 0.0));
  return {static_cast<float>(level * std::sin(azimuth)), static_cast<float>(y),
          static_cast<float>(-level * std::cos(azimuth))};
}

}  // namespace luciole
