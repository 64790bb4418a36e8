// SPDX-License-Identifier: Apache-2.0
// Random tiles and ellipsoids around them, in double.
#pragma once
#include <array>

#include "equations/test_support.h"

namespace luciole::test {

inline const f64::ViewFrame kEye{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// A 16 x 16 tile of a 240 x 135 picture with a field of view of 60 degrees, both halves the same depth range.
inline f64::Tile random_tile(Dice& dice) {
  const double pixel = 2 * std::tan(kPi / 6) / 135;
  const double x = (16 * std::floor(dice.uniform(0, 15)) - 120) * pixel,
               y = (16 * std::floor(dice.uniform(0, 9)) - 68) * pixel;
  const double low = dice.log_uniform(1, 30), high = low * (1 + dice.log_uniform(1e-3, 1));
  return {x, x + 16 * pixel, y, y + 16 * pixel, low, high, low, high};
}

inline f64::BoundingEllipsoid random_ellipsoid(Dice& dice, real3 centre, double least_alpha) {
  const double alpha = dice.log_uniform(least_alpha, 1);
  f64::BoundingEllipsoid e;
  e.centre = centre;
  e.axis_u = dice.direction();
  e.axis_w = f64::normalize(f64::cross(e.axis_u, dice.direction()));
  e.r_v = dice.log_uniform(0.01, 2);
  e.r_u = (1 + alpha * alpha) / (2 * alpha) * e.r_v;
  e.r_w = e.r_v * dice.uniform(0.05, 1);
  return e;
}

inline real3 point_in(Dice& dice, const f64::Tile& tile) {
  const double z = dice.uniform(tile.near_low, tile.near_high);
  return {z * dice.uniform(tile.x_low, tile.x_high), z * dice.uniform(tile.y_low, tile.y_high), z};
}
inline real3 point_near(Dice& dice, const f64::Tile& tile) {
  return point_in(dice, tile) + dice.direction() * dice.log_uniform(0.01, 10);
}

inline std::array<real3, 8> stretched_corners(const f64::TileTestEllipsoid& t, const f64::Tile& tile) {
  std::array<real3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[static_cast<std::size_t>(i)] = f64::stretched_corner(
        t, i & 1 ? tile.x_high : tile.x_low, i & 2 ? tile.y_high : tile.y_low, i & 4 ? tile.near_high : tile.near_low);
  }
  return corners;
}

// The box distance of the near half, as ellipsoid_touches_tile computes it.
inline double box_distance_sq(const f64::TileTestEllipsoid& t, const f64::Tile& tile) {
  const auto slopes = f64::stretched_slopes(t.factor, tile);
  return f64::stretched_distance_sq(t.stretched, t.factor.m22, slopes, tile.near_low, tile.near_high);
}

}  // namespace luciole::test
