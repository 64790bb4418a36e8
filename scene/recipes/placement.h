// SPDX-License-Identifier: Apache-2.0
// Where things stand: affine maps by their names. Angles in radians, counter-clockwise seen against the axis.
#pragma once
#include <cmath>
#include <numbers>

#include "base/affine.h"

namespace luciole::workshop {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kTwoPi = 2 * kPi;
inline constexpr float radians(float degrees) { return degrees * (kPi / 180); }

inline Affine translate(Vec3 by) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, by}; }
inline Affine scale(Vec3 by) { return {{by.x, 0, 0}, {0, by.y, 0}, {0, 0, by.z}, {0, 0, 0}}; }
inline Affine rotate_x(float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{1, 0, 0}, {0, c, s}, {0, -s, c}, {0, 0, 0}};
}
inline Affine rotate_y(float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {0, 0, 0}};
}
inline Affine rotate_z(float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}, {0, 0, 0}};
}

}  // namespace luciole::workshop
