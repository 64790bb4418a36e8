// SPDX-License-Identifier: Apache-2.0
#include "real_time/reflective_shadow_map/direction_maps.h"

#include <cmath>
#include <numbers>

namespace luciole {
namespace {

// Cosine and sine by way of double: the standard library picks its float versions by processor, and they differ in the
// last bit; rounded from double they are the same bits everywhere.
Vec2 circle_point(double angle) { return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}; }

}  // namespace

Vec3 octahedral_direction(Vec2 point) {
  const float a = 2 * point.x - 1, b = 2 * point.y - 1;
  const float height = 1 - (std::abs(a) + std::abs(b));  // positive inside the diamond: upper hemisphere
  const float radius = 1 - std::abs(height);             // 0 at a pole, 1 at the equator
  // The position along the side of the diamond is the azimuth, a quarter turn per side.
  const double along = radius > 0 ? static_cast<double>((std::abs(b) - std::abs(a)) / radius) + 1.0 : 1.0;
  const Vec2 azimuth = circle_point(along * (std::numbers::pi / 4));
  const float sine = radius * std::sqrt(2 - radius * radius);  // z = 1 - radius^2: equal areas
  return {std::copysign(azimuth.x * sine, a), std::copysign(azimuth.y * sine, b),
          std::copysign(1 - radius * radius, height)};
}

Vec3 cone_direction(Vec2 point, float cos_outer) {
  const float a = 2 * point.x - 1, b = 2 * point.y - 1;
  const bool sideways = std::abs(a) > std::abs(b);
  const float radius = sideways ? a : b;
  const double ratio = radius == 0 ? 0.0 : static_cast<double>(sideways ? b / a : a / b);
  const double angle =
      sideways ? ratio * (std::numbers::pi / 4) : std::numbers::pi / 2 - ratio * (std::numbers::pi / 4);
  const float fall = radius * radius * (1 - cos_outer);  // 1 - z
  const float sine = std::copysign(std::sqrt(fall * (2 - fall)), radius);
  const Vec2 azimuth = circle_point(angle);
  return {azimuth.x * sine, azimuth.y * sine, 1 - fall};
}

Basis frame_around(Vec3 axis) {
  // From the world axis that is farthest from this one, so that the cross product is never short.
  const Vec3 size = abs(axis);
  Vec3 far_axis(0, 0, 1);
  if (size.x <= size.y && size.x <= size.z) {
    far_axis = Vec3(1, 0, 0);
  } else if (size.y <= size.z) {
    far_axis = Vec3(0, 1, 0);
  }
  const Vec3 right = normalize(cross(far_axis, axis));
  return {right, cross(axis, right), axis};
}

}  // namespace luciole
