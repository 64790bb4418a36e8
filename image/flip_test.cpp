// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace luciole {
namespace {

constexpr std::uint32_t kWidth = 64, kHeight = 48;

template <class Colour>
std::vector<Vec3> picture(Colour colour) {
  std::vector<Vec3> pixels;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) pixels.push_back(colour(x, y));
  }
  return pixels;
}

float hashed(std::uint32_t x, std::uint32_t y) { return float(((y * kWidth + x) * 2654435761u) >> 24) / 255.0f; }

// A chequered colour ramp.
Vec3 ramp(std::uint32_t x, std::uint32_t y) {
  const float stripe = (x / 8 + y / 8) % 2 ? 1.0f : 0.25f;
  return Vec3(stripe * float(x) / 63.0f, stripe * float(y) / 47.0f, 0.5f * stripe);
}

// The ramp with noise on red and blue.
Vec3 noisy_ramp(std::uint32_t x, std::uint32_t y) {
  const Vec3 clean = ramp(x, y);
  const float noise = hashed(x, y);
  return Vec3(clean.x * 0.8f + 0.2f * noise, clean.y, clean.z * (1 - noise * 0.5f));
}

std::vector<float> map_of(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return flip_map(a, b, kWidth, kHeight);
}

double mean_flip(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const std::vector<float> map = map_of(a, b);
  return std::accumulate(map.begin(), map.end(), 0.0) / double(map.size());
}

TEST(Flip, equal_pictures_do_not_differ) { EXPECT_EQ(mean_flip(picture(ramp), picture(ramp)), 0); }

TEST(Flip, is_symmetric) {
  EXPECT_EQ(map_of(picture(ramp), picture(noisy_ramp)), map_of(picture(noisy_ramp), picture(ramp)));
}

// Uniform pictures: no features, filters without effect. Black against white is a HyAB distance of 100, of at most
// 203 (green against blue), hence 0.95 + 0.05 (0.6085 - 0.4) / 0.6.
TEST(Flip, black_against_white_has_the_published_value) {
  const auto black = picture([](auto, auto) { return Vec3(0, 0, 0); });
  const auto white = picture([](auto, auto) { return Vec3(1, 1, 1); });
  EXPECT_NEAR(mean_flip(black, white), 0.9674, 2e-4);
  const auto green = picture([](auto, auto) { return Vec3(0, 1, 0); });
  const auto blue = picture([](auto, auto) { return Vec3(0, 0, 1); });
  EXPECT_NEAR(mean_flip(green, blue), 1, 1e-5);
}

// Recorded from the authors' own program (version 1.6, C++, defaults) on the same two pictures.
TEST(Flip, agrees_with_the_program_of_its_authors) {
  const std::vector<float> map = map_of(picture(ramp), picture(noisy_ramp));
  EXPECT_NEAR(std::accumulate(map.begin(), map.end(), 0.0) / double(map.size()), 0.295759, 2e-5);
  EXPECT_NEAR(map[0], 0.301289, 2e-5);
  EXPECT_NEAR(map[1000], 0.230704, 2e-5);
  EXPECT_NEAR(map[3071], 0.302545, 2e-5);
}

TEST(Flip, more_noise_is_more_difference_and_everything_stays_within_one) {
  double before = 0;
  for (const float amount : {0.02f, 0.1f, 0.5f, 1.0f}) {
    const auto noisy = picture([&](std::uint32_t x, std::uint32_t y) {
      return ramp(x, y) * (1 - amount) + Vec3(1, 1, 1) * (amount * hashed(x, y));
    });
    const double after = mean_flip(picture(ramp), noisy);
    EXPECT_GT(after, before);
    before = after;
    const std::vector<float> map = map_of(picture(ramp), noisy);
    EXPECT_LE(*std::max_element(map.begin(), map.end()), 1.0f);
  }
}

// What the eye cannot resolve hardly counts: a fine chequer against its own mean, beside a coarse one.
TEST(Flip, an_unresolved_pattern_differs_less_than_a_coarse_one) {
  const auto chequer = [](std::uint32_t period) {
    return picture([=](std::uint32_t x, std::uint32_t y) {
      const float value = (x / period + y / period) % 2 ? 0.6f : 0.4f;
      return Vec3(value, value, value);
    });
  };
  const auto grey = picture([](auto, auto) { return Vec3(0.5f, 0.5f, 0.5f); });
  EXPECT_LT(mean_flip(chequer(1), grey), 0.3 * mean_flip(chequer(8), grey));
}

TEST(Flip, pictures_smaller_than_its_filters_are_no_problem) {
  EXPECT_EQ(flip_map({Vec3(1, 0, 0)}, {Vec3(1, 0, 0)}, 1, 1)[0], 0);
  EXPECT_GT(flip_map({Vec3(1, 0, 0)}, {Vec3(0, 0, 1)}, 1, 1)[0], 0.5f);
}

}  // namespace
}  // namespace luciole
