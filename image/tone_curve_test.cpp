// SPDX-License-Identifier: Apache-2.0
#include "image/tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace luciole {
namespace {

Vec3 neutral(float r, float g, float b) { return apply_tone_curve(ToneCurve::pbr_neutral, Vec3(r, g, b)); }

// Specification: below the start of compression the output is the input less min(0.04, x - x^2/0.16).
TEST(PbrNeutral, is_the_identity_less_the_reflection_below_the_start_of_compression) {
  EXPECT_NEAR(neutral(0.5f, 0.3f, 0.2f).x, 0.46f, 1e-6f);
  EXPECT_NEAR(neutral(0.5f, 0.3f, 0.2f).z, 0.16f, 1e-6f);
  EXPECT_NEAR(neutral(0.8f, 0.8f, 0.8f).y, 0.76f, 1e-6f);
  EXPECT_NEAR(neutral(0.5f, 0.3f, 0.04f).x, 0.5f - 0.03f, 1e-6f);
  EXPECT_EQ(neutral(0.7f, 0.5f, 0).x, 0.7f);  // a saturated colour is not touched
  EXPECT_EQ(neutral(0, 0, 0).x, 0);
}

TEST(PbrNeutral, grey_rises_steadily_with_slope_at_most_one_and_stays_below_one) {
  float before = 0;
  for (float grey = 0.1f; grey < 1e4f; grey *= 1.01f) {
    const float after = neutral(grey, grey, grey).x;
    EXPECT_GE(after, before) << grey;
    EXPECT_LE(after, grey);
    EXPECT_LE(after, 1.0f);
    before = after;
  }
  EXPECT_GT(before, 0.999f);
}

TEST(PbrNeutral, compression_starts_without_a_step_or_a_kink) {
  const float h = 1e-3f;
  const float below = neutral(0.8f, 0.8f, 0.8f).x - neutral(0.8f - h, 0.8f - h, 0.8f - h).x;
  const float above = neutral(0.8f + h, 0.8f + h, 0.8f + h).x - neutral(0.8f, 0.8f, 0.8f).x;
  EXPECT_NEAR(below / h, 1, 1e-3);
  EXPECT_NEAR(above / h, 1, 1e-2);
}

TEST(PbrNeutral, bright_colours_go_to_white_and_the_linear_curve_clips_them) {
  const Vec3 bright = neutral(100, 1, 1);
  EXPECT_GT(bright.y, 0.8f);
  const Vec3 clipped = apply_tone_curve(ToneCurve::linear, Vec3(100, 0.25f, -1));
  EXPECT_EQ(clipped.x, 1);
  EXPECT_EQ(clipped.y, 0.25f);
  EXPECT_EQ(clipped.z, 0);
}

// The formula of the specification at one compressed colour, computed by hand: c = (2, 1, .5), f = .04, p = 1.96,
// p_n = 1 - .24^2/1.44 = .96, g = 1/(.15 * 1 + 1).
TEST(PbrNeutral, agrees_with_the_specification_where_it_compresses) {
  const Vec3 out = neutral(2, 1, 0.5f);
  const float g = 1 / 1.15f;
  EXPECT_NEAR(out.x, 0.96f, 1e-6f);
  EXPECT_NEAR(out.y, 0.96f * (0.96f / 1.96f) * g + 0.96f * (1 - g), 1e-6f);
  EXPECT_NEAR(out.z, 0.46f * (0.96f / 1.96f) * g + 0.96f * (1 - g), 1e-6f);
}

TEST(ToneCurve, odd_values_stay_on_the_screen) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const ToneCurve curve : {ToneCurve::pbr_neutral, ToneCurve::linear}) {
    for (const float odd : {infinity, -infinity, std::nanf(""), 3e38f, -1.0f}) {
      const Vec3 out = apply_tone_curve(curve, Vec3(odd, 0.5f, odd));
      for (const float value : {out.x, out.y, out.z}) EXPECT_TRUE(value >= 0 && value <= 1) << odd;
    }
  }
}

TEST(ToneCurve, names_are_unique_and_unknown_ones_are_refused) {
  for (const ToneCurve curve : {ToneCurve::pbr_neutral, ToneCurve::linear}) {
    EXPECT_EQ(tone_curve_by_name(tone_curve_name(curve)), curve);
  }
  EXPECT_FALSE(tone_curve_by_name("filmic").has_value());
}

TEST(ToneCurve, exposure_scales_before_the_curve) {
  EXPECT_EQ(to_display({Vec3(0.1f, 0.1f, 0.1f)}, 3, ToneCurve::linear)[0].x, 0.1f * 3);
}

// IEC 61966-2-1: the linear piece ends at 0.0031308; code 188 is 50 % grey (to the nearest code).
TEST(Srgb, known_points_and_round_trip) {
  EXPECT_EQ(srgb_encode(0), 0);
  EXPECT_FLOAT_EQ(srgb_encode(1), 1);
  EXPECT_NEAR(srgb_encode(0.0031308f), 0.04045f, 1e-5f);
  EXPECT_EQ(std::lround(srgb_encode(0.5f) * 255), 188);
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(std::lround(srgb_encode(srgb_decode(float(code) / 255)) * 255), code);
  }
}

TEST(SrgbCodes, begin_at_their_edges_and_nowhere_else) {
  const auto edges = srgb_code_edges();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const int code = static_cast<int>(i) + 1;
    EXPECT_EQ(srgb_code(edges[i]), code);
    EXPECT_EQ(srgb_code(std::nextafter(edges[i], 0.0f)), code - 1);
  }
  // Whoever counts edges has the code, also where powers are rounded one way and the other.
  std::size_t reached = 0;
  for (float x = 0; x <= 1; x += 1e-6f) {
    while (reached < edges.size() && x >= edges[reached]) ++reached;
    ASSERT_EQ(srgb_code(x), reached) << x;
  }
  for (const float edge : edges) {
    float below = edge, above = edge;
    const int code = srgb_code(edge);
    for (int step = 0; step < 1000; ++step) {
      below = std::nextafter(below, 0.0f);
      ASSERT_EQ(srgb_code(below), code - 1);
      ASSERT_EQ(srgb_code(above), code);
      above = std::nextafter(above, 2.0f);
    }
  }
}

TEST(SrgbCodes, of_pictures_are_those_of_their_values) {
  std::vector<Vec3> display = {{-1, 0, -0.0f}, {1, 2, std::nextafter(1.0f, 0.0f)}, {1e-40f, 1e-8f, NAN}};
  for (const float edge : srgb_code_edges()) {
    display.emplace_back(std::nextafter(edge, 0.0f), edge, std::nextafter(edge, 2.0f));
  }
  for (float x = 0; x <= 1; x += 3e-5f) display.emplace_back(x, x + 1e-5f, x + 2e-5f);
  const std::vector<std::uint8_t> codes = srgb_codes(display);
  ASSERT_EQ(codes.size(), 3 * display.size());
  for (std::size_t i = 0; i < display.size(); ++i) {
    ASSERT_EQ(codes[3 * i], srgb_code(display[i].x)) << display[i].x;
    ASSERT_EQ(codes[3 * i + 1], srgb_code(display[i].y)) << display[i].y;
    ASSERT_EQ(codes[3 * i + 2], srgb_code(display[i].z)) << display[i].z;
  }
}

}  // namespace
}  // namespace luciole
