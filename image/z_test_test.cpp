// SPDX-License-Identifier: Apache-2.0
// The test is itself an estimator: right renderers must pass it whatever the seed, likely mistakes must not.
#include "image/z_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace luciole {
namespace {

constexpr std::uint32_t kSide = 32;
constexpr std::uint32_t kFrames = 256;
constexpr std::size_t kPixels = std::size_t(kSide) * kSide;

// One light as one pixel sees it: accepted with probability p, then worth contribution / p.
struct SeenLight {
  Vec3 contribution;
  float p;
};
using SeenLights = std::vector<std::vector<SeenLight>>;  // per pixel

// Lights in a room, probabilities as of 1/l^2 over a floor, some of them certain.
SeenLights room_with_lights() {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0, 1);
  SeenLights pixels(kPixels);
  for (auto& lights : pixels) {
    for (int i = 0; i < 16; ++i) {
      const float fall_off = std::exp(-6 * unit(random) + 1);
      const float cosine = unit(random);
      lights.push_back({Vec3(fall_off * cosine, 0.7f * fall_off * cosine, 0.1f * fall_off), std::min(1.0f, fall_off)});
    }
  }
  return pixels;
}

// Every pixel sees one light, accepted once in 1,000 frames.
SeenLights rare_lights() { return SeenLights(kPixels, {{Vec3(1, 1, 1), 0.001f}}); }

FrameExpectation expectation_of(const SeenLights& pixels) {
  FrameExpectation expected{kSide, kSide, {}, {}, {}};
  for (const auto& lights : pixels) {
    Vec3 mean(0, 0, 0), variance(0, 0, 0);
    float accepted = 0;
    for (const auto& [contribution, p] : lights) {
      mean += contribution;
      variance += contribution * contribution * (1 / p - 1);
      accepted += p;
    }
    expected.mean.push_back(mean);
    expected.variance.push_back(variance);
    expected.accepted.push_back(accepted);
  }
  return expected;
}

// What a renderer does with the probability that it accepts with, and with its finished frame.
struct Renderer {
  float acceptance_scale = 1;  // below 1: ranges are too short
  float weight = 1;
  bool block_shares_numbers = false;  // one random number per 8x8 block instead of one per pixel
  bool divides_by_p = true;
  std::function<void(std::vector<Vec3>&, std::mt19937&)> finish = [](std::vector<Vec3>&, std::mt19937&) {};
};

std::vector<Vec3> render(const SeenLights& pixels, const Renderer& renderer, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Vec3> frame(pixels.size());
  std::vector<float> shared(kPixels / 64);
  for (float& xi : shared) xi = unit(random);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t block = i / kSide / 8 * (kSide / 8) + i % kSide / 8;
    for (const auto& [contribution, p] : pixels[i]) {
      const float xi = renderer.block_shares_numbers ? shared[block] : unit(random);
      const float threshold = p < 1 ? p * renderer.acceptance_scale : 1;
      if (xi < threshold) frame[i] += contribution * (renderer.weight / (renderer.divides_by_p ? p : 1));
    }
  }
  renderer.finish(frame, random);
  return frame;
}

EstimatorStatistics statistics_of(const SeenLights& pixels, const Renderer& renderer, unsigned seed) {
  std::mt19937 random(seed);
  EstimatorStatistics statistics(expectation_of(pixels), kFrames);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) statistics.add(render(pixels, renderer, random));
  return statistics;
}

void expect_rejected(const Renderer& renderer) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const ZTestReport report = image_z_test(statistics_of(room_with_lights(), renderer, seed));
    EXPECT_FALSE(report.passed);
    EXPECT_FALSE(report.reason.empty());
  }
}

TEST(NormalQuantile, agrees_with_tables_and_inverts_erfc) {
  EXPECT_NEAR(two_sided_normal_quantile(0.05), 1.959963984540054, 1e-12);
  EXPECT_NEAR(two_sided_normal_quantile(0.01), 2.575829303548901, 1e-12);
  EXPECT_NEAR(two_sided_normal_quantile(1), 0, 1e-9);
  for (double tail = 0.9; tail > 1e-300; tail *= 1e-3) {
    EXPECT_NEAR(std::erfc(two_sided_normal_quantile(tail) / std::sqrt(2.0)) / tail, 1, 1e-10) << tail;
  }
}

TEST(SidakLimit, keeps_the_chance_of_any_false_alarm) {
  EXPECT_NEAR(sidak_limit(1, 0.05), 1.959963984540054, 1e-12);
  for (const std::uint64_t values : {10u, 1000u, 1000000u}) {
    const double each = std::erfc(sidak_limit(values, 0.01) / std::sqrt(2.0));
    EXPECT_NEAR(1 - std::pow(1 - each, double(values)), 0.01, 1e-6);
  }
}

TEST(EstimatorStatistics, mean_is_the_mean_of_the_frames) {
  const SeenLights pixels(kPixels, {{Vec3(1, 2, 3), 1.0f}});
  EstimatorStatistics statistics(expectation_of(pixels), 2);
  statistics.add(std::vector<Vec3>(kPixels, Vec3(0, 2, 8)));
  statistics.add(std::vector<Vec3>(kPixels, Vec3(1, 2, 0)));
  const Vec3 mean = statistics.mean()[17];
  EXPECT_FLOAT_EQ(mean.x, 0.5f);
  EXPECT_FLOAT_EQ(mean.y, 2);
  EXPECT_FLOAT_EQ(mean.z, 4);
}

// 40 runs at a nominal chance of 0.011 of a false alarm each: more than 4 have a chance below 0.0002.
TEST(ZTest, a_right_estimator_passes_for_almost_every_seed) {
  const SeenLights pixels = room_with_lights();
  int rejected = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const ZTestReport report = image_z_test(statistics_of(pixels, {}, seed));
    EXPECT_EQ(report.single_pixels, kPixels);
    EXPECT_EQ(report.values, 3 * kPixels);
    rejected += report.passed ? 0 : 1;
  }
  EXPECT_LE(rejected, 4);
}

TEST(ZTest, ranges_five_percent_short_are_rejected) {
  Renderer short_ranges;
  short_ranges.acceptance_scale = 0.95f * 0.95f;
  expect_rejected(short_ranges);
}

TEST(ZTest, a_weight_of_63_for_64_is_rejected) {
  Renderer wrong_weight;
  wrong_weight.weight = 63.0f / 64.0f;
  expect_rejected(wrong_weight);
}

TEST(ZTest, forgetting_the_probability_is_rejected) {
  Renderer clamped;
  clamped.divides_by_p = false;
  expect_rejected(clamped);
}

TEST(ZTest, thirty_percent_more_variance_than_predicted_is_rejected) {
  const FrameExpectation expected = expectation_of(room_with_lights());
  Renderer noisy;
  noisy.finish = [&](std::vector<Vec3>& frame, std::mt19937& random) {
    std::normal_distribution<float> normal(0, std::sqrt(0.3f));
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const Vec3 v = expected.variance[i];
      frame[i] += Vec3(std::sqrt(v.x), std::sqrt(v.y), std::sqrt(v.z)) * normal(random);
    }
  };
  expect_rejected(noisy);
  EXPECT_NEAR(image_z_test(statistics_of(room_with_lights(), noisy, 1)).variance_ratio, 1.3, 0.05);
}

TEST(ZTest, one_pixel_off_by_ten_deviations_is_rejected_and_named) {
  const FrameExpectation expected = expectation_of(room_with_lights());
  Renderer one_wrong_pixel;
  one_wrong_pixel.finish = [&](std::vector<Vec3>& frame, std::mt19937&) {
    frame[77].y += 10 * std::sqrt(expected.variance[77].y / kFrames);
  };
  const ZTestReport report = image_z_test(statistics_of(room_with_lights(), one_wrong_pixel, 1));
  EXPECT_FALSE(report.passed);
  EXPECT_EQ(report.worst_pixel, 77u);
}

TEST(ZTest, rare_lights_pass_thanks_to_pooling) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ZTestReport report = image_z_test(statistics_of(rare_lights(), {}, seed));
    EXPECT_TRUE(report.passed) << seed << ": " << report.reason;
    EXPECT_EQ(report.single_pixels, 0u);
    EXPECT_GE(report.blocks, 1u);
  }
}

TEST(ZTest, rare_lights_without_pooling_would_be_rejected) {
  FrameExpectation expected = expectation_of(rare_lights());
  for (float& accepted : expected.accepted) accepted = 1;  // claims that every pixel stands for itself
  std::mt19937 random(1);
  EstimatorStatistics statistics(expected, kFrames);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) statistics.add(render(rare_lights(), {}, random));
  EXPECT_FALSE(image_z_test(statistics).passed);
}

TEST(ZTest, rare_lights_of_half_the_weight_are_rejected) {
  Renderer half;
  half.weight = 0.5f;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    EXPECT_FALSE(image_z_test(statistics_of(rare_lights(), half, seed)).passed);
  }
}

// All pixels of a block accept in the same frames: 64 accepted lights are one event, and the sum of p misleads.
TEST(ZTest, blocks_that_share_their_random_numbers_are_not_mistaken_for_many_events) {
  const SeenLights pixels(kPixels, {{Vec3(1, 1, 1), 0.05f}});
  Renderer shared;
  shared.block_shares_numbers = true;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ZTestReport report = image_z_test(statistics_of(pixels, shared, seed));
    EXPECT_TRUE(report.passed) << seed << ": " << report.reason;
    EXPECT_LT(report.blocks, kPixels / 64);
  }
}

TEST(ZTest, a_pixel_without_noise_must_be_exact) {
  const SeenLights pixels(kPixels, {{Vec3(1, 2, 3), 1.0f}});
  EXPECT_TRUE(image_z_test(statistics_of(pixels, {}, 1)).passed);
  Renderer off_by_rounding;
  off_by_rounding.weight = 1 + 2e-7f;
  EXPECT_TRUE(image_z_test(statistics_of(pixels, off_by_rounding, 1)).passed);
  Renderer off;
  off.weight = 1 + 2e-5f;
  EXPECT_FALSE(image_z_test(statistics_of(pixels, off, 1)).passed);
}

TEST(ZTest, missing_frames_and_values_that_are_no_numbers_are_rejected) {
  EstimatorStatistics unfinished(expectation_of(room_with_lights()), kFrames);
  EXPECT_FALSE(image_z_test(unfinished).passed);
  Renderer broken;
  broken.finish = [](std::vector<Vec3>& frame, std::mt19937&) { frame[5].x = std::nanf(""); };
  EXPECT_FALSE(image_z_test(statistics_of(room_with_lights(), broken, 1)).passed);
}

TEST(FrameExpectation, comes_from_the_layers_of_a_reference) {
  Image reference;
  reference.width = reference.height = 1;
  reference.set_colours("", {Vec3(1, 2, 3)});
  EXPECT_FALSE(frame_expectation(reference).has_value());
  reference.set_colours("predicted_variance", {Vec3(4, 5, 6)});
  reference.set_values("predicted_accepted", {7});
  const auto expected = frame_expectation(reference);
  ASSERT_TRUE(expected.has_value());
  EXPECT_EQ(expected->mean[0].y, 2);
  reference.set_colours("reference", {Vec3(8, 9, 10)});
  EXPECT_EQ(frame_expectation(reference)->mean[0].y, 9);
  EXPECT_EQ(expected->variance[0].z, 6);
  EXPECT_EQ(expected->accepted[0], 7);
}

}  // namespace
}  // namespace luciole
