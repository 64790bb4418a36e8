// SPDX-License-Identifier: Apache-2.0
// Sampling against density by chi-square, and energy: no surface reflects more than it receives.
#include "offline/path/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "offline/path/sample_sequence.h"

namespace luciole {
namespace {

constexpr double kPi = std::numbers::pi;

SurfacePoint surface(float alpha, float diffuse, float f0) {
  SurfacePoint point{};
  point.geometric_normal = point.shading_normal = {0, 0, 1};
  point.diffuse_albedo = {diffuse, diffuse, diffuse};
  point.f0 = {f0, f0, f0}, point.f90 = 1, point.ggx_alpha = alpha;
  return point;
}

Vec3 direction(float cosine, float azimuth) {
  const float sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

// Cells of equal solid angle over the hemisphere; directions that are not sampled come last.
constexpr int kRows = 12, kColumns = 16, kCells = kRows * kColumns;

int cell_of(Vec3 d) {
  const int row = std::min(static_cast<int>(d.z * kRows), kRows - 1);
  const double turn = std::atan2(double(d.y), double(d.x)) / (2 * kPi) + 0.5;
  return row * kColumns + std::min(static_cast<int>(turn * kColumns), kColumns - 1);
}

// The density integrated over each cell, by a fine midpoint rule; `spoil` multiplies it.
std::vector<double> expected_share(const Bsdf& bsdf, double spoil) {
  constexpr int kFine = 48;
  std::vector<double> share(kCells + 1, 0.0);
  const double cell = 2 * kPi / kCells / (kFine * kFine);
  double all = 0;
  for (int row = 0; row < kRows * kFine; ++row) {
    for (int column = 0; column < kColumns * kFine; ++column) {
      const auto cosine = static_cast<float>((row + 0.5) / (kRows * kFine));
      const auto turn = static_cast<float>(((column + 0.5) / (kColumns * kFine) - 0.5) * 2 * kPi);
      const double density = bsdf.pdf(direction(cosine, turn)) * (row < kRows * kFine / 2 ? spoil : 1);
      share[static_cast<std::size_t>((row / kFine) * kColumns + column / kFine)] += density * cell;
      all += density * cell;
    }
  }
  share[kCells] = std::max(1 - all, 0.0);
  return share;
}

// Chi-square of the sampled histogram, in standard deviations of its distribution (approximately normal).
double chi_square_deviation(const Bsdf& bsdf, double spoil) {
  constexpr int kSamples = 400000;
  std::vector<int> histogram(kCells + 1, 0);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    SampleSequence numbers(11, i, 0);  // of many pixels: independent
    const Vec2 place = numbers.pair();
    const BsdfSample sample = bsdf.sample(place, numbers.pair().x);
    ++histogram[static_cast<std::size_t>(sample.pdf > 0 ? cell_of(sample.direction) : kCells)];
  }
  const std::vector<double> share = expected_share(bsdf, spoil);
  double chi_square = 0, freedom = -1, pooled_expected = 0, pooled_seen = 0;
  for (std::size_t cell = 0; cell < share.size(); ++cell) {
    const double expected = share[cell] * kSamples, seen = histogram[cell];
    if (expected < 20) {
      pooled_expected += expected, pooled_seen += seen;
      continue;
    }
    chi_square += (seen - expected) * (seen - expected) / expected;
    ++freedom;
  }
  if (pooled_expected > 5) {
    chi_square += (pooled_seen - pooled_expected) * (pooled_seen - pooled_expected) / pooled_expected;
    ++freedom;
  }
  return (chi_square - freedom) / std::sqrt(2 * freedom);
}

TEST(Bsdf, directions_are_distributed_as_their_density_says) {
  for (const float alpha : {0.3f, 0.6f, 1.0f}) {
    for (const float cosine : {0.95f, 0.5f, 0.15f}) {
      for (const float diffuse : {0.0f, 0.7f}) {
        const Bsdf bsdf(surface(alpha, diffuse, 0.2f), direction(cosine, 0.4f));
        EXPECT_LT(chi_square_deviation(bsdf, 1), 4.5) << alpha << " " << cosine << " " << diffuse;
      }
    }
  }
}

TEST(Bsdf, a_share_of_the_diffuse_lobe_is_left_out_as_its_density_says) {
  const Bsdf bsdf(surface(0.5f, 0.7f, 0.04f), direction(0.6f, 0), 0.25f);
  EXPECT_LT(chi_square_deviation(bsdf, 1), 4.5);
}

TEST(Bsdf, a_density_three_percent_off_is_caught) {
  const Bsdf bsdf(surface(0.6f, 0.7f, 0.2f), direction(0.5f, 0.4f));
  EXPECT_GT(chi_square_deviation(bsdf, 1.03), 10);
}

// Mean weight = albedo for this direction; white surfaces lose light between microfacets, but never gain.
double albedo(const Bsdf& bsdf, int samples) {
  double sum = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(samples); ++i) {
    SampleSequence numbers(5, i, 0);
    const Vec2 place = numbers.pair();
    sum += bsdf.sample(place, numbers.pair().x).weight.x;
  }
  return sum / samples;
}

TEST(Bsdf, metals_reflect_no_more_than_they_receive) {
  for (const float alpha : {0.001f, 0.05f, 0.3f, 1.0f}) {
    for (const float cosine : {1.0f, 0.6f, 0.1f, 0.01f}) {
      EXPECT_LT(albedo(Bsdf(surface(alpha, 0, 1), direction(cosine, 1)), 20000), 1.01) << alpha << " " << cosine;
    }
  }
}

// glTF's mix takes Fresnel at the half vector, for the base too: a white base under a smooth coat gains light at
// grazing angles (1.4 at a cosine of .1), which diffuse light from all sides does not.
TEST(Bsdf, coated_surfaces_reflect_no_more_than_they_receive_from_all_sides) {
  for (const float alpha : {0.001f, 0.05f, 0.3f, 1.0f}) {
    double sum = 0;
    constexpr int kDirections = 64;
    for (int i = 0; i < kDirections; ++i) {
      const float cosine = std::sqrt((static_cast<float>(i) + 0.5f) / kDirections);
      sum += albedo(Bsdf(surface(alpha, 0.9f, 0.04f), direction(cosine, 1)), 2000);
    }
    EXPECT_LT(sum / kDirections, 1.01) << alpha;
  }
}

TEST(Bsdf, a_smooth_mirror_reflects_all) {
  const Bsdf bsdf(surface(0.001f, 0, 1), direction(0.5f, 1));
  EXPECT_NEAR(albedo(bsdf, 20000), 1, 0.002);
}

TEST(Bsdf, weight_is_value_over_density) {
  const Bsdf bsdf(surface(0.2f, 0.5f, 0.3f), direction(0.7f, 2));
  for (std::uint32_t i = 0; i < 1000; ++i) {
    SampleSequence numbers(5, i, 0);
    const Vec2 place = numbers.pair();
    const BsdfSample sample = bsdf.sample(place, numbers.pair().x);
    if (!(sample.pdf > 0)) continue;
    const float value = bsdf.evaluate(sample.direction).x / bsdf.pdf(sample.direction);
    EXPECT_NEAR(sample.weight.x, value, 1e-4f * value);
  }
}

TEST(Bsdf, is_black_below_either_normal) {
  SurfacePoint point = surface(0.5f, 0.8f, 0.04f);
  point.shading_normal = normalize(Vec3(0.6f, 0, 0.8f));
  const Bsdf bsdf(point, direction(0.9f, 0));
  const Vec3 below_triangle(0.99f, 0, -0.1f), below_shading(-0.95f, 0, 0.3f);
  EXPECT_EQ(bsdf.evaluate(normalize(below_triangle)).x, 0);
  EXPECT_EQ(bsdf.evaluate(normalize(below_shading)).x, 0);
  EXPECT_EQ(bsdf.pdf(normalize(below_triangle)), 0);
}

}  // namespace
}  // namespace luciole
