// SPDX-License-Identifier: Apache-2.0
#include "offline/path/sample_sequence.h"

#include <gtest/gtest.h>

#include <vector>

namespace luciole {
namespace {

// The points of one pair of dimensions, 2^m of them.
std::vector<Vec2> points(std::uint32_t pixel, int pairs_before, int m) {
  std::vector<Vec2> result;
  for (std::uint64_t sample = 0; sample < (std::uint64_t(1) << m); ++sample) {
    SampleSequence numbers(7, pixel, sample);
    for (int k = 0; k < pairs_before; ++k) numbers.pair();
    result.push_back(numbers.pair());
  }
  return result;
}

// How many of the 2^m cells of 2^-a by 2^-(m-a) do not hold exactly one point.
int wrong_cells(const std::vector<Vec2>& points, int a, int m) {
  std::vector<int> held(points.size(), 0);
  for (const Vec2& p : points) {
    const auto x = static_cast<std::size_t>(p.x * static_cast<float>(1 << a));
    const auto y = static_cast<std::size_t>(p.y * static_cast<float>(1 << (m - a)));
    ++held[(x << (m - a)) + y];
  }
  int wrong = 0;
  for (const int count : held) wrong += count != 1;
  return wrong;
}

TEST(SampleSequence, every_pair_is_a_net_in_base_two) {
  for (std::uint32_t pixel = 0; pixel < 8; ++pixel) {
    for (int m = 1; m <= 10; ++m) {
      const std::vector<Vec2> net = points(pixel, static_cast<int>(pixel), m);
      for (int a = 0; a <= m; ++a)
        EXPECT_EQ(wrong_cells(net, a, m), 0) << "pixel " << pixel << " m " << m << " a " << a;
    }
  }
}

TEST(SampleSequence, points_of_two_pixels_together_are_no_net) {
  std::vector<Vec2> mixed = points(1, 0, 5);
  for (const Vec2& p : points(2, 0, 5)) mixed.push_back(p);
  EXPECT_GT(wrong_cells(mixed, 3, 6), 0);
}

// Pairs of one sample must not know of each other: their products' mean is that of independent numbers.
TEST(SampleSequence, pairs_are_uncorrelated) {
  constexpr int kPixels = 20000;
  for (const std::uint64_t sample : {0ull, 1ull, 5ull, 1ull << 33u}) {
    double sum = 0;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
      SampleSequence numbers(3, pixel, sample);
      const Vec2 first = numbers.pair(), second = numbers.pair();
      sum += (first.x - 0.5) * (second.x - 0.5) + (first.y - 0.5) * (second.x - 0.5);
    }
    const double deviation = std::sqrt(2.0 / 144 / kPixels);
    EXPECT_LT(std::abs(sum / kPixels), 4 * deviation) << sample;
  }
}

TEST(SampleSequence, seeds_and_late_samples_differ) {
  const auto first = [](std::uint32_t seed, std::uint64_t sample) { return SampleSequence(seed, 0, sample).pair().x; };
  EXPECT_NE(first(1, 0), first(2, 0));
  EXPECT_NE(first(1, 0), first(1, std::uint64_t(1) << 32u));
}

}  // namespace
}  // namespace luciole
