// SPDX-License-Identifier: Apache-2.0
#include "report/linear_pixels.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace luciole {
namespace {

// As page.js has it.
float value_of(std::uint16_t half) {
  const int exponent = half >> 10, mantissa = half & 1023;
  return exponent == 0 ? std::ldexp(float(mantissa), -24) : std::ldexp(float(1024 + mantissa), exponent - 25);
}

// The reader's side, as page.js has it.
std::vector<std::uint8_t> decoded(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    word = word << 6 | static_cast<std::uint32_t>(digits.find(letter));
    bits += 6;
    if (bits >= 8) bits -= 8, bytes.push_back(static_cast<std::uint8_t>(word >> bits));
  }
  return bytes;
}

TEST(HalfCode, is_the_nearest_to_half_a_step_over_the_range_of_a_screen) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> stops(-14, 15);
  for (int i = 0; i < 100000; ++i) {
    const float value = std::exp2(stops(random));
    EXPECT_NEAR(value_of(half_code(value)), value, value / 2048) << value;
  }
  for (std::uint16_t code = 0; code <= 0x7bff; ++code) ASSERT_EQ(half_code(value_of(code)), code);
}

// 1 + 1.5/1024 and 1 + 2.5/1024 lie in the middle; cutting the bits off would give the lower code for both.
TEST(HalfCode, ties_go_to_the_even_code) {
  EXPECT_EQ(value_of(half_code(1 + 1.5f / 1024)), 1 + 2.0f / 1024);
  EXPECT_EQ(value_of(half_code(1 + 2.5f / 1024)), 1 + 2.0f / 1024);
  EXPECT_EQ(value_of(half_code(1 + 2047.0f / 2048)), 2);
}

TEST(HalfCode, what_no_screen_can_show_is_black_or_the_largest_value) {
  for (const float value : {0.0f, -1.0f, std::nanf(""), 1e-9f, 1e-41f}) EXPECT_EQ(half_code(value), 0) << value;
  for (const float value : {65504.0f, 65520.0f, 1e30f, std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(value_of(half_code(value)), 65504.0f) << value;
  }
}

TEST(Base64, agrees_with_the_examples_of_rfc_4648) {
  const auto text = [](const std::string& letters) { return base64({letters.begin(), letters.end()}); };
  EXPECT_EQ(text(""), "");
  EXPECT_EQ(text("f"), "Zg==");
  EXPECT_EQ(text("fo"), "Zm8=");
  EXPECT_EQ(text("foo"), "Zm9v");
  EXPECT_EQ(text("foobar"), "Zm9vYmFy");
}

TEST(LinearPixels, come_back_row_by_row_from_the_top_and_exposed) {
  const std::vector<Vec3> pixels = {Vec3(1, 0, 0), Vec3(0, 2, 0),  Vec3(0, 0, 4),
                                    Vec3(1, 1, 0), Vec3(-1, 0, 0), Vec3(3, 3, 3)};
  const std::vector<std::uint8_t> packed = decoded(linear_pixels_text(pixels, 3, 0.5f));
  std::vector<std::uint8_t> planes(6 * pixels.size());
  uLongf size = planes.size();
  ASSERT_EQ(uncompress(planes.data(), &size, packed.data(), packed.size()), Z_OK);
  ASSERT_EQ(size, planes.size());
  const auto channel = [&](std::size_t plane) {
    std::vector<float> values;
    std::uint16_t code = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const int difference = planes[plane * pixels.size() + i] | planes[(plane + 3) * pixels.size() + i] << 8;
      code = static_cast<std::uint16_t>((i % 3 == 0 ? 0 : code) + difference);
      values.push_back(value_of(code));
    }
    return values;
  };
  EXPECT_EQ(channel(0), (std::vector<float>{0.5f, 0, 0, 0.5f, 0, 1.5f}));
  EXPECT_EQ(channel(1), (std::vector<float>{0, 1, 0, 0.5f, 0, 1.5f}));
  EXPECT_EQ(channel(2), (std::vector<float>{0, 0, 2, 0, 0, 1.5f}));
}

}  // namespace
}  // namespace luciole
