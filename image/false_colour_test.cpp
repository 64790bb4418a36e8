// SPDX-License-Identifier: Apache-2.0
#include "image/false_colour.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "image/metrics.h"
#include "image/tone_curve.h"

namespace luciole {
namespace {

std::array<int, 3> codes(Vec3 colour) {
  const auto code = [](float linear) { return static_cast<int>(srgb_encode(linear) * 255 + 0.5f); };
  return {code(colour.x), code(colour.y), code(colour.z)};
}

constexpr std::array<int, 3> kBlack{0, 0, 0}, kPaleYellow{254, 243, 211}, kRed{216, 34, 105};

// CIE 1976 lightness of a luminance relative to white.
float lightness(Vec3 colour) {
  const float y = luminance(colour);
  return y > 216.0f / 24389.0f ? 116 * std::cbrt(y) - 16 : y * 24389.0f / 27.0f;
}

TEST(FalseColour, runs_from_black_to_pale_yellow_with_even_lightness) {
  EXPECT_EQ(codes(false_colour(0)), kBlack);
  EXPECT_EQ(codes(false_colour(0.5f)), kRed);
  EXPECT_EQ(codes(false_colour(1)), kPaleYellow);
  float before = -1;
  for (int i = 0; i <= 256; ++i) {
    const float value = static_cast<float>(i) / 256, now = lightness(false_colour(value));
    EXPECT_GT(now, before) << value;
    // Mixed by sRGB codes between nine colours, of which whole codes are kept.
    EXPECT_NEAR(now, 96 * value, 3.0f) << value;
    before = now;
  }
}

TEST(FalseColour, what_is_beyond_the_scale_has_the_colour_of_its_end) {
  EXPECT_EQ(codes(false_colour(-1)), kBlack);
  EXPECT_EQ(codes(false_colour(7)), kPaleYellow);
  EXPECT_EQ(codes(false_colour(std::numeric_limits<float>::infinity())), kPaleYellow);
  EXPECT_EQ(codes(false_colour(std::nanf(""))), kPaleYellow);
}

// The scale has four decades; the middle one ends at 0.1.
TEST(FalseColour, a_relative_error_of_a_tenth_is_red_and_one_of_a_twentieth_is_not) {
  const auto colours = error_colours({0, 0.001f, 0.05f, 0.1f, 10, std::numeric_limits<float>::infinity()});
  EXPECT_EQ(codes(colours[0]), kBlack);
  EXPECT_EQ(codes(colours[1]), kBlack);
  EXPECT_NE(codes(colours[2]), kRed);
  EXPECT_EQ(codes(colours[3]), kRed);
  EXPECT_EQ(codes(colours[4]), kPaleYellow);
  EXPECT_EQ(codes(colours[5]), kPaleYellow);
}

// FLIP has a linear scale: on that of relative errors a tenth would be red, too.
TEST(FalseColour, a_flip_of_one_half_is_red_and_one_of_a_tenth_is_not) {
  const auto colours = flip_colours({0, 0.5f, 0.1f, 1});
  EXPECT_EQ(codes(colours[0]), kBlack);
  EXPECT_EQ(codes(colours[1]), kRed);
  EXPECT_NE(codes(colours[2]), kRed);
  EXPECT_EQ(codes(colours[3]), kPaleYellow);
}

}  // namespace
}  // namespace luciole
