// SPDX-License-Identifier: Apache-2.0
// How many lights a point evaluates when N lights share one total intensity: [TH16] sect. 3.2 calls it sublinear. With
// alpha = a N the expected count over a set of dimension D through the point is sqrt(N) for D = 1, log N for D = 2,
// constant for D = 3, and constant for a plane that does not contain the point. docs/mathematics.md derives the
// formulas.
#include <cmath>
#include <vector>

#include "equations/test_support.h"

namespace luciole::test {

constexpr double kA = 2.0;  // a [1/m^2]; lights within radius 1
enum class Layout { line, disc_through_point, disc_above_point, ball };
constexpr double kHeight = 0.05;

double distance_sq(Dice& dice, Layout layout) {
  switch (layout) {
    case Layout::line: {
      const double x = dice.uniform(-1, 1);
      return x * x;
    }
    case Layout::disc_through_point:
      return dice.uniform();
    case Layout::disc_above_point:
      return dice.uniform() + kHeight * kHeight;
    default:
      return std::pow(dice.uniform(), 2.0 / 3.0);
  }
}

// Expected number of accepted lights, sum of min(1/(alpha l^2), 1).
double formula(Layout layout, double n) {
  const double l0_sq = 1 / (kA * n), l0 = std::sqrt(l0_sq);
  switch (layout) {
    case Layout::line:
      return 2 * std::sqrt(n / kA) - 1 / kA;
    case Layout::disc_through_point:
      return (1 + std::log(kA * n)) / kA;
    case Layout::disc_above_point: {
      const double rho_sq = std::max(l0_sq - kHeight * kHeight, 0.0), h_sq = kHeight * kHeight;
      return n * rho_sq + std::log((1 + h_sq) / (rho_sq + h_sq)) / kA;
    }
    default:
      return n * l0 * l0_sq + 3 * (1 - l0) / kA;
  }
}

struct Count {
  double mean = 0, sigma = 0;  // of the mean, predicted
};

// Mean over random layouts of the number of accepted lights. xi_scale < 1 is the mistake of ranges too long.
Count count_accepted(Layout layout, std::uint32_t n, std::uint32_t layouts, double xi_scale) {
  Dice dice(71);
  const double falloff_floor = kA * n;
  double sum = 0, sum_sq = 0;
  for (std::uint32_t t = 0; t < layouts; ++t) {
    double accepted = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double xi = f64::unit_real(dice.bits()) * xi_scale;
      accepted += f64::survival_probability(f64::fall_off(distance_sq(dice, layout)), falloff_floor) > xi;
    }
    sum += accepted, sum_sq += accepted * accepted;
  }
  const double mean = sum / layouts, variance = sum_sq / layouts - mean * mean;
  return {mean, std::sqrt(formula(layout, n) / layouts + variance / layouts)};
}

TEST(SublinearCost, is_what_the_integral_over_the_lights_predicts) {
  for (Layout layout : {Layout::line, Layout::disc_through_point, Layout::disc_above_point, Layout::ball})
    for (std::uint32_t n : {1u << 10, 1u << 14, 1u << 18}) {
      const std::uint32_t layouts = (1u << 21) / n;
      const Count count = count_accepted(layout, n, layouts, 1);
      EXPECT_LT(std::abs(count.mean - formula(layout, n)), kSigmas * count.sigma)
          << static_cast<int>(layout) << " " << n;
    }
  const Count count = count_accepted(Layout::line, 1 << 10, 2048, 0.9);
  EXPECT_GT(std::abs(count.mean - formula(Layout::line, 1 << 10)), kSigmas * count.sigma)
      << "ranges 5 % long are caught";
}

double exponent(Layout layout) {  // from N = 2^10 to 2^18
  return std::log2(formula(layout, 1 << 18) / formula(layout, 1 << 10)) / 8;
}

TEST(SublinearCost, grows_as_the_dimension_of_the_lights_says) {
  EXPECT_NEAR(exponent(Layout::line), 0.5, 0.02);
  EXPECT_LT(std::abs(exponent(Layout::ball)), 0.03);
  EXPECT_LT(std::abs(exponent(Layout::disc_above_point)), 0.03);
  const double step = formula(Layout::disc_through_point, 64 * 4096) - formula(Layout::disc_through_point, 4096);
  EXPECT_NEAR(step, std::log(64.0) / kA, 0.05 * step);
}

// The rival: one range for all lights, [TH16] Appendix A, from the same error bound.
TEST(ClampedRanges, cost_in_proportion_to_the_number_of_lights) {
  Dice dice(72);
  const auto count = [&](std::uint32_t n) {
    const double eps = 100 / (kPi * 0.04), range_sq = f64::clamped_range_sq(eps, 1, 100.0 / n, n);  // .04 m^2 for any n
    double inside = 0;
    for (std::uint32_t i = 0; i < n; ++i) inside += distance_sq(dice, Layout::disc_through_point) < range_sq;
    return inside;
  };
  EXPECT_NEAR(std::log2(count(1 << 20) / count(1 << 12)) / 8, 1.0, 0.02);
  EXPECT_LT(exponent(Layout::disc_through_point), 0.2) << "the stochastic ranges do not";
}

// Relative standard deviation of the sum of N lights over frames; lights fixed on a disc above the point.
double relative_deviation(std::uint32_t n, std::uint32_t frames, bool floor_grows) {
  Dice dice(73);
  const double falloff_floor = kA * (floor_grows ? n : 1 << 10);
  std::vector<std::uint32_t> threshold(n);  // p as 32 bits: the comparison of the roulette, made cheap for 10^9 draws
  std::vector<float> survivor(n);
  double exact = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double f = f64::fall_off(distance_sq(dice, Layout::disc_above_point));
    threshold[i] = static_cast<std::uint32_t>(f64::survival_probability(f, falloff_floor) * 4294967295.0);
    survivor[i] = static_cast<float>(std::max(f, falloff_floor));
    exact += f;
  }
  std::uint64_t state = 0x9e3779b97f4a7c15ull;
  double sum_sq = 0;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      state ^= state << 13, state ^= state >> 7, state ^= state << 17;
      sum += static_cast<std::uint32_t>(state >> 32) < threshold[i] ? survivor[i] : 0.0f;
    }
    sum_sq += (sum / exact - 1) * (sum / exact - 1);
  }
  return std::sqrt(sum_sq / frames);
}

TEST(ErrorBound, keeps_the_noise_of_all_lights_together_independent_of_their_number) {
  const double few = relative_deviation(1 << 10, 4000, true), many = relative_deviation(1 << 18, 4000, true);
  EXPECT_NEAR(many, few, 0.1 * few);
  EXPECT_LT(relative_deviation(1 << 18, 100, false), 0.5 * few) << "a floor that does not grow with N is caught";
}

}  // namespace luciole::test
