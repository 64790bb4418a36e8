// SPDX-License-Identifier: Apache-2.0
// Maps from the square to directions: unit vectors, turned as the library's cosine says, one for each point.
// real_time/reflective_shadow_map/light_map_test.cpp shows that they preserve area.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "equations/cpp/double.h"
#include "equations/cpp/float.h"

namespace luciole {
namespace {

constexpr double kU = 0x1p-24;

TEST(EighthTurn, is_cosine_and_sine) {
  double of_double = 0, of_float = 0, without_last_terms = 0;
  for (int i = -1000; i <= 1000; ++i) {
    const double t = i / 1000.0, angle = t * std::numbers::pi / 4;
    const f64::real2 d = f64::eighth_turn(t);
    of_double = std::max({of_double, std::abs(d.x - std::cos(angle)), std::abs(d.y - std::sin(angle))});
    const float single = static_cast<float>(t);
    const f32::real2 f = f32::eighth_turn(single);
    const double rounded = double(single) * std::numbers::pi / 4;
    of_float =
        std::max({of_float, std::abs(double(f.x) - std::cos(rounded)), std::abs(double(f.y) - std::sin(rounded))});
    const double shorter = angle - std::pow(angle, 3) / 6 + std::pow(angle, 5) / 120;
    without_last_terms = std::max(without_last_terms, std::abs(shorter - std::sin(angle)));
  }
  const double a = std::numbers::pi / 4;
  EXPECT_LE(of_double, std::pow(a, 11) / 39916800);  // the first term left out
  EXPECT_LE(of_float, 4 * kU);
  EXPECT_GT(without_last_terms, 100 * 4 * kU) << "the control";
}

// Rounding of a sine by way of 2 - r^2 and of the square's coordinates, which are up to 1.
TEST(DirectionMaps, give_unit_vectors_that_agree_with_double_precision) {
  for (int y = 0; y <= 64; ++y) {
    for (int x = 0; x <= 64; ++x) {
      const float u = static_cast<float>(x) / 64, v = static_cast<float>(y) / 64;
      const f32::real3 o = f32::octahedral_direction({u, v}), c = f32::cone_direction({u, v}, 0.3f);
      const f64::real3 right = f64::octahedral_direction({double(u), double(v)});
      EXPECT_NEAR(double(length(o)), 1, 8 * kU);
      EXPECT_NEAR(double(length(c)), 1, 8 * kU);
      EXPECT_NEAR(double(o.x), right.x, 8 * kU);
      EXPECT_NEAR(double(o.y), right.y, 8 * kU);
      EXPECT_NEAR(double(o.z), right.z, 8 * kU);
      EXPECT_GE(double(c.z), 0.3 - 4 * kU);
    }
  }
  EXPECT_EQ(f32::octahedral_direction({0.5f, 0.5f}).z, 1.0f);
  EXPECT_EQ(f32::octahedral_direction({0.0f, 1.0f}).z, -1.0f);
  EXPECT_EQ(f32::cone_direction({0.5f, 0.5f}, 0.3f).z, 1.0f);
}

}  // namespace
}  // namespace luciole
