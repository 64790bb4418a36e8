// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "equations/test_support.h"

namespace luciole::test {

using f64::real;

f64::SurfaceBrdf brdf_of(const TextbookLobe& lobe) {
  f64::SurfaceBrdf brdf;
  brdf.f0 = {lobe.f0, lobe.f0 * 0.5, 0};
  brdf.f90 = lobe.f90;
  brdf.ggx_alpha = lobe.alpha;
  return brdf;
}

TEST(Reflection, is_the_textbooks_lobe) {
  Dice dice(1);
  double largest_error = 0, error_of_separable = 0;
  for (int i = 0; i < 200000; ++i) {
    const TextbookLobe lobe = random_lobe(dice, 1e-3);
    const real3 out = outgoing_direction(dice, lobe);
    const auto fixed = f64::fix_direction(brdf_of(lobe), {0, 0, 1}, lobe.incident);
    const double specular = f64::reflection(fixed, out).specular.x;
    largest_error = std::max(largest_error, std::abs(specular / lobe.intensity(out, true) - 1));
    error_of_separable = std::max(error_of_separable, std::abs(specular / lobe.intensity(out, false) - 1));
  }
  EXPECT_LT(largest_error, 1e-6);  // the textbook's own cancellation at the horizon
  EXPECT_GT(error_of_separable, 0.1) << "separable masking is caught";
}

TEST(Reflection, of_the_diffuse_base_loses_what_the_brightest_channel_reflects) {
  Dice dice(2);
  for (int i = 0; i < 10000; ++i) {
    const TextbookLobe lobe = random_lobe(dice, 1e-3);
    const real3 out = outgoing_direction(dice, lobe);
    const auto fixed = f64::fix_direction(brdf_of(lobe), {0, 0, 1}, lobe.incident);
    const double expected = (1 - lobe.fresnel(out)) * out.z / kPi;
    EXPECT_NEAR(f64::reflection(fixed, out).diffuse, expected, 1e-12);
    EXPECT_NEAR(f64::diffuse_reflection(fixed, out), expected, 1e-12);
  }
}

TEST(Reflection, is_reciprocal) {
  Dice dice(3);
  for (int i = 0; i < 10000; ++i) {
    const TextbookLobe lobe = random_lobe(dice, 1e-2);
    const real3 out = outgoing_direction(dice, lobe);
    const auto there = f64::reflection(f64::fix_direction(brdf_of(lobe), {0, 0, 1}, lobe.incident), out);
    const auto back = f64::reflection(f64::fix_direction(brdf_of(lobe), {0, 0, 1}, out), lobe.incident);
    EXPECT_NEAR(there.specular.x / out.z, back.specular.x / lobe.incident.z, 1e-9 * there.specular.x / out.z);
    EXPECT_NEAR(there.diffuse / out.z, back.diffuse / lobe.incident.z, 1e-12);
  }
}

TEST(Reflection, is_zero_below_the_horizon_and_finite_on_it) {
  f32::SurfaceBrdf brdf;
  brdf.f0 = {0.04f, 0.04f, 0.04f};
  brdf.f90 = 1;
  brdf.ggx_alpha = 1e-3f;
  for (float cos_fixed : {-0.5f, 0.0f, 1e-7f, 0.3f, 1.0f}) {
    const float s = std::sqrt(1 - cos_fixed * cos_fixed);
    const auto fixed = f32::fix_direction(brdf, {0, 0, 1}, {s, 0, cos_fixed});
    for (float cos_other : {-1.0f, -0.2f, 0.0f, 1e-7f, 0.5f}) {
      const auto r = f32::reflection(fixed, {-std::sqrt(1 - cos_other * cos_other), 0, cos_other});
      EXPECT_TRUE(std::isfinite(r.specular.x) && std::isfinite(r.diffuse)) << cos_fixed << " " << cos_other;
      EXPECT_GE(r.specular.x, 0.0f);
      if (cos_other <= 0) {
        EXPECT_EQ(r.specular.x, 0.0f);
        EXPECT_EQ(r.diffuse, 0.0f);
      }
    }
  }
}

// Share of the energy that a white surface reflects, by quadrature over the hemisphere in the half-vector's measure.
double albedo(double alpha, double cos_incident, bool with_masking) {
  f64::SurfaceBrdf brdf;
  brdf.f0 = {1, 1, 1};
  brdf.f90 = 1;
  brdf.ggx_alpha = alpha;
  TextbookLobe lobe{{std::sqrt(1 - cos_incident * cos_incident), 0, cos_incident}, alpha, 1, 1};
  const auto fixed = f64::fix_direction(brdf, {0, 0, 1}, lobe.incident);
  double sum = 0;
  const int steps = 400;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {  // h drawn by D cos(theta_m): dw_o = 4 (w_i.h) dw_h
      const double u = (i + 0.5) / steps, tan_sq = alpha * alpha * u / (1 - u), z = 1 / std::sqrt(1 + tan_sq);
      const double phi = 2 * kPi * (j + 0.5) / steps, s = std::sqrt(1 - z * z);
      const real3 h(s * std::cos(phi), s * std::sin(phi), z);
      const double i_h = f64::dot(h, lobe.incident);
      const real3 out = h * (2 * i_h) - lobe.incident;
      if (i_h <= 0 || out.z <= 0) continue;
      const double pdf = lobe.distribution(out) * z / (4 * i_h);
      sum +=
          (with_masking ? f64::reflection(fixed, out).specular.x : lobe.distribution(out) / (4 * cos_incident)) / pdf;
    }
  return sum / steps / steps;
}

TEST(Reflection, never_creates_energy) {
  for (double alpha : {0.05, 0.3, 1.0})
    for (double c : {0.1, 0.5, 1.0}) {
      EXPECT_LT(albedo(alpha, c, true), 1.0 + 1e-3);
      EXPECT_GT(albedo(alpha, c, true), 0.3);
    }
  EXPECT_GT(albedo(0.3, 0.1, false), 1.05) << "a lobe without masking is caught";
}

TEST(LargestFresnel, bounds_every_direction_and_is_attained_at_the_horizon) {
  Dice dice(4);
  double largest_ratio = 0, ratio_to_normal_incidence = 0;
  for (int i = 0; i < 1000000; ++i) {
    const TextbookLobe lobe = random_lobe(dice, 1e-3);
    const real3 out = outgoing_direction(dice, lobe);
    const double c = lobe.incident.z, s = std::sqrt(1 - c * c);
    const double bound = f64::largest_fresnel(lobe.f0, lobe.f90, c, s);
    largest_ratio = std::max(largest_ratio, lobe.fresnel(out) / bound);
    ratio_to_normal_incidence = std::max(ratio_to_normal_incidence, lobe.fresnel(out) / lobe.f0);
    const real3 horizon = real3(-lobe.incident.x / s, -lobe.incident.y / s, 1e-9);
    if (s > 1e-3 && i < 100000) {
      ASSERT_NEAR(lobe.fresnel(horizon) / bound, 1, 1e-6);
    }
  }
  EXPECT_LE(largest_ratio, 1 + 1e-12);
  EXPECT_GT(ratio_to_normal_incidence, 2.0) << "taking f0 for the maximum is caught";
  EXPECT_NEAR(f64::largest_fresnel(0, 1, 1, 0), 0.002155, 1e-6);
  EXPECT_EQ(f64::largest_fresnel(0.5, 0.2, 0.3, std::sqrt(0.91)), 0.5);
}

TEST(GgxDistribution, keeps_its_digits_in_float_at_the_smallest_roughness) {
  Dice dice(5);
  float worst = 0, worst_naive = 0;
  for (int i = 0; i < 10000; ++i) {
    const double alpha = 1e-3, tan_m = alpha * dice.uniform(0.1, 3), sin_m = tan_m / std::sqrt(1 + tan_m * tan_m);
    const float s = static_cast<float>(sin_m), c = static_cast<float>(std::sqrt(1 - sin_m * sin_m));
    const double exact = f64::ggx_distribution(alpha * alpha, 1 - sin_m * sin_m, sin_m * sin_m);
    const float alpha_sq = static_cast<float>(alpha * alpha);
    worst = std::max(worst, std::abs(f32::ggx_distribution(alpha_sq, c * c, s * s) / static_cast<float>(exact) - 1));
    worst_naive = std::max(worst_naive,
                           std::abs(f32::ggx_distribution(alpha_sq, c * c, 1 - c * c) / static_cast<float>(exact) - 1));
  }
  EXPECT_LT(worst, 1e-5f);
  EXPECT_GT(worst_naive, 0.05f) << "1 - cos^2 is caught";
}

TEST(Reflection, in_float_keeps_three_digits_at_the_smallest_roughness) {
  Dice dice(6);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    TextbookLobe lobe{{0.6, 0, 0.8}, 1e-3, 1, 1};
    const real3 h = f64::normalize(dice.direction() * (2e-3 * dice.uniform()) + real3(0, 0, 1));
    const f32::real3 in = rounded(lobe.incident), out = rounded(h * (2 * f64::dot(h, lobe.incident)) - lobe.incident);
    f32::SurfaceBrdf brdf;
    brdf.f0 = {1, 1, 1};
    brdf.f90 = 1;
    brdf.ggx_alpha = 1e-3f;
    const float result = f32::reflection(f32::fix_direction(brdf, {0, 0, 1}, in), out).specular.x;
    lobe.incident = f64::normalize(widened(in));
    worst = std::max(worst, std::abs(result / lobe.intensity(f64::normalize(widened(out)), true) - 1));
  }
  EXPECT_LT(worst, 2e-3);
}

TEST(MetallicRoughness, blends_between_dielectric_and_metal) {
  const auto plastic = f64::metallic_roughness_brdf({0.8, 0.4, 0.2}, 0, {0.04, 0.04, 0.04}, 1, 0.3);
  EXPECT_EQ(plastic.diffuse_albedo.x, 0.8);
  EXPECT_EQ(plastic.f0.x, 0.04);
  const auto metal = f64::metallic_roughness_brdf({0.8, 0.4, 0.2}, 1, {0.04, 0.04, 0.04}, 0.5, 0.3);
  EXPECT_EQ(metal.diffuse_albedo.x, 0.0);
  EXPECT_EQ(metal.f0.y, 0.4);
  EXPECT_EQ(metal.f90, 1.0);  // KHR_materials_specular leaves metals alone
  EXPECT_NE(plastic.f0.x, metal.f0.x);
}

TEST(LobeIntensity, is_flux_times_reflection) {
  const TextbookLobe lobe{f64::normalize(real3(0.3, -0.2, 0.7)), 0.2, 0.5, 1};
  const real3 out = f64::normalize(real3(-0.2, 0.3, 0.9));
  const auto fixed = f64::fix_direction(brdf_of(lobe), {0, 0, 1}, lobe.incident);
  EXPECT_NEAR(f64::glossy_lobe_intensity(fixed, {2, 3, 4}, out).x, 2 * lobe.intensity(out, true), 1e-12);
  const real3 diffuse = f64::diffuse_lobe_intensity(fixed, {0.5, 0.25, 0}, {2, 3, 4}, out);
  EXPECT_NEAR(diffuse.y, 0.75 * (1 - lobe.fresnel(out)) * out.z / kPi, 1e-12);
  EXPECT_NE(diffuse.y, 0.75 * out.z / kPi) << "the base under a reflecting surface gets less light";
}

}  // namespace luciole::test
