// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include "equations/test_support.h"

namespace luciole::test {

using f64::real;
constexpr std::uint32_t kDraws = 1 << 22;

real draw(std::uint32_t i, std::uint32_t lobe) { return f64::unit_real(f64::random_words(11, 0, i, lobe).first); }

struct FallOffSums {
  double sum = 0, sum_unweighted = 0;
  std::uint32_t disagreements = 0;  // of l < r with p > xi
};

FallOffSums roulette(real distance, real falloff_floor) {
  FallOffSums sums;
  const real f = f64::fall_off(distance * distance);
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    const real xi = draw(i, 0);
    const real estimate = f64::stochastic_fall_off(f, falloff_floor, xi);
    const bool in_range = distance * distance < f64::stochastic_range_sq(falloff_floor, xi);
    sums.sum += estimate;
    sums.sum_unweighted += estimate > 0 ? f : 0;
    sums.disagreements += in_range != (estimate > 0) ? 1 : 0;
  }
  return sums;
}

TEST(StochasticFallOff, averages_to_the_inverse_square_law) {
  const real falloff_floor = 0.37;
  for (real scaled : {0.3, 0.9999, 1.5, 10.0}) {
    const real distance = scaled / std::sqrt(falloff_floor), f = f64::fall_off(distance * distance);
    const real variance = f64::fall_off_variance(f, falloff_floor);
    const FallOffSums sums = roulette(distance, falloff_floor);
    EXPECT_EQ(sums.disagreements, 0u) << scaled;
    if (scaled < 1) {
      EXPECT_EQ(variance, 0.0);
      EXPECT_NEAR(sums.sum / kDraws, f, 1e-9 * f);
    } else {
      EXPECT_LT(std::abs(z_of_mean(sums.sum, kDraws, f, variance)), kSigmas) << scaled;
      EXPECT_GT(std::abs(z_of_mean(sums.sum_unweighted, kDraws, f, variance)), 100.0)
          << "forgetting the survival probability is caught";
    }
  }
}

TEST(FallOffVariance, is_largest_where_the_floor_is_twice_the_fall_off) {
  const real falloff_floor = 2.5;
  real low = 0.1, high = 10;
  for (int i = 0; i < 200; ++i) {  // ternary search
    const real a = low + (high - low) / 3, b = high - (high - low) / 3;
    const bool left = f64::fall_off_variance(f64::fall_off(a * a), falloff_floor) >
                      f64::fall_off_variance(f64::fall_off(b * b), falloff_floor);
    (left ? high : low) = left ? b : a;
  }
  EXPECT_NEAR(low, std::sqrt(2 / falloff_floor), 1e-5 * low);
  EXPECT_NEAR(std::sqrt(f64::fall_off_variance(f64::fall_off(low * low), falloff_floor)), falloff_floor / 2, 1e-6);
}

// Standard deviation of a pixel on a Lambert surface lit by one light at its worst distance.
real pixel_deviation(real max_error, real exposure, real intensity, real floor_scale) {
  const real falloff_floor = floor_scale * f64::falloff_floor_of_error(max_error, exposure, intensity);
  real sum = 0, sum_sq = 0;
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    const real pixel =
        exposure * intensity * f64::stochastic_fall_off(falloff_floor / 2, falloff_floor, draw(i, 1)) / kPi;
    sum += pixel, sum_sq += pixel * pixel;
  }
  return std::sqrt(sum_sq / kDraws - sum / kDraws * sum / kDraws);
}

TEST(ErrorBound, is_the_standard_deviation_of_one_light) {
  EXPECT_NEAR(pixel_deviation(0.0005, 3.0, 7.0, 1.0), 0.0005, 0.005 * 0.0005);
  EXPECT_GT(pixel_deviation(0.0005, 3.0, 7.0, 1.1), 1.005 * 0.0005) << "a floor 10 % too high is caught";
}

TEST(ErrorBound, of_an_area_light_is_that_of_its_intensity) {
  EXPECT_DOUBLE_EQ(f64::falloff_floor_of_area_light(0.01, 2, 5, 0.25), f64::falloff_floor_of_error(0.01, 2, 1.25));
  EXPECT_NE(f64::falloff_floor_of_area_light(0.01, 2, 5, 0.5), f64::falloff_floor_of_error(0.01, 2, 1.25));
}

TEST(ErrorBound, in_both_papers_gives_the_same_probability) {
  const real eps = 0.002, exposure = 1.7, intensity = 30, l_sq = 19000;
  const real by_fall_off =
      f64::survival_probability(f64::fall_off(l_sq), f64::falloff_floor_of_error(eps, exposure, intensity));
  const real by_radiance = f64::acceptance_probability(exposure * intensity, f64::delta_of_error(eps), l_sq);
  EXPECT_NEAR(by_fall_off, by_radiance, 1e-14);
  EXPECT_LT(by_radiance, f64::acceptance_probability(exposure * intensity, eps, l_sq)) << "delta is not eps";
}

TEST(ClampedRange, keeps_the_summed_bias_under_the_bound_but_does_not_shrink_with_the_light_count) {
  const real eps = 0.01, exposure = 2, total = 50;
  const real few = f64::clamped_range_sq(eps, exposure, total / 100, 100);
  EXPECT_DOUBLE_EQ(few, f64::clamped_range_sq(eps, exposure, total / 10000, 10000));
  EXPECT_NEAR(exposure * total / few / kPi, eps, 1e-15);  // all lights just outside their range
  EXPECT_GT(f64::stochastic_range_sq(f64::falloff_floor_of_error(eps, exposure, total / 100), 0.5),
            50 * f64::stochastic_range_sq(f64::falloff_floor_of_error(eps, exposure, total / 10000), 0.5));
}

TEST(AcceptanceProbability, exceeds_xi_exactly_within_the_directional_range) {
  Dice dice(1);
  int outside = 0;
  for (int i = 0; i < 1000000; ++i) {
    const real peak = dice.log_uniform(1e-3, 1e3), delta = 0.001, l_sq = dice.log_uniform(1e-2, 1e8), xi = draw(i, 2);
    const bool accepted = f64::acceptance_probability(peak, delta, l_sq) > xi;
    ASSERT_EQ(accepted, f64::light_is_accepted(peak, delta, l_sq, xi));
    ASSERT_EQ(accepted, l_sq < f64::directional_range_sq(peak, delta, xi));
    const real weight = f64::inverse_acceptance_probability(peak, delta, l_sq);
    ASSERT_NEAR(weight * f64::acceptance_probability(peak, delta, l_sq), 1, 1e-12);
    outside += accepted ? 0 : 1;
  }
  EXPECT_GT(outside, 1000);
}

TEST(NearFieldDisc, never_reaches_beyond_the_point_lights_range) {
  const real peak = 3, delta = 0.01, xi = 0.2, area = 4;
  const real range_sq = f64::directional_range_sq(peak, delta, xi);
  EXPECT_FALSE(f64::light_is_accepted(peak, delta, f64::near_field_distance_sq(range_sq * 0.9995, area), xi));
  EXPECT_TRUE(f64::light_is_accepted(peak, delta, f64::near_field_distance_sq(range_sq - area / kPi - 1e-6, area), xi));
  EXPECT_TRUE(f64::light_is_accepted(peak, delta, f64::near_field_distance_sq(range_sq * 0.9995, 0), xi));
  EXPECT_GT(f64::near_field_distance_sq(0, area), 1.0) << "finite at the light itself";
}

// Two lobes of one light, radiances L_d and L_s at a point, each culled by its own number.
struct TwoLobes {
  double mean = 0, variance = 0, mean_without_division = 0;
};
TwoLobes two_lobes(real diffuse, real glossy, const std::function<real(real, std::uint32_t)>& second) {
  TwoLobes result;
  double sum_sq = 0;
  for (std::uint32_t i = 0; i < kDraws; ++i) {
    const real xi_diffuse = draw(i, 3), xi_glossy = second(xi_diffuse, i);
    const real d = diffuse > xi_diffuse ? 1 : 0, g = glossy > xi_glossy ? 1 : 0;  // delta = 1: L/p = 1
    result.mean += d + g;
    result.mean_without_division += d + glossy * g;
    sum_sq += (d + g) * (d + g);
  }
  result.mean /= kDraws, result.mean_without_division /= kDraws;
  result.variance = sum_sq / kDraws - result.mean * result.mean;
  return result;
}

TEST(TwoLobes, keep_their_mean_for_any_coupling_and_complement_has_least_variance) {
  for (const auto& [diffuse, glossy] : {std::pair<real, real>{0.3, 0.05}, std::pair<real, real>{0.1, 0.1}}) {
    const real total = diffuse + glossy, ideal = total - total * total;  // delta L - L^2
    const TwoLobes apart = two_lobes(diffuse, glossy, [](real, std::uint32_t i) { return draw(i, 4); });
    const TwoLobes same = two_lobes(diffuse, glossy, [](real xi, std::uint32_t) { return xi; });
    const TwoLobes complement = two_lobes(diffuse, glossy, [](real xi, std::uint32_t) { return 1 - xi; });
    for (const TwoLobes& lobes : {apart, same, complement}) {
      EXPECT_LT(std::abs(z_of_mean(lobes.mean * kDraws, kDraws, total, lobes.variance)), kSigmas);
      EXPECT_GT(std::abs(z_of_mean(lobes.mean_without_division * kDraws, kDraws, total, lobes.variance)), 50.0);
    }
    EXPECT_NEAR(complement.variance, ideal, 0.02 * ideal);
    EXPECT_GT(apart.variance, 1.05 * ideal);
    EXPECT_GT(same.variance, apart.variance);
  }
}

}  // namespace luciole::test
