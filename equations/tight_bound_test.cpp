// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "equations/test_support.h"

namespace luciole::test {

using f64::real;
enum Bound { kNarrowed, kFitted, kTight };

f64::BoundingEllipsoid bound_of(Bound bound, const f64::GlossyLobe& glossy, const TextbookLobe& lobe) {
  const real size = f64::lobe_size(glossy, lobe.f0, lobe.f90, 1.0);
  return bound == kNarrowed ? f64::narrowed_ellipsoid(glossy, size)
         : bound == kFitted ? f64::fitted_ellipsoid(glossy, size)
                            : f64::tight_ellipsoid(glossy, lobe.f0, lobe.f90, 1.0);
}

f32::BoundingEllipsoid bound_in_float(Bound bound, f32::real3 incident, const TextbookLobe& lobe) {
  const float alpha = static_cast<float>(lobe.alpha), f0 = static_cast<float>(lobe.f0),
              f90 = static_cast<float>(lobe.f90);
  const auto glossy = f32::glossy_lobe({0, 0, 0}, {0, 0, 1}, incident, alpha);
  const float size = f32::lobe_size(glossy, f0, f90, 1.0f);
  return bound == kNarrowed ? f32::narrowed_ellipsoid(glossy, size)
         : bound == kFitted ? f32::fitted_ellipsoid(glossy, size)
                            : f32::tight_ellipsoid(glossy, f0, f90, 1.0f);
}

f64::BoundingEllipsoid widened(const f32::BoundingEllipsoid& e) {
  f64::BoundingEllipsoid w;
  w.centre = widened(e.centre);
  w.axis_u = f64::normalize(widened(e.axis_u));
  const real3 across = widened(e.axis_w);
  w.axis_w = f64::normalize(across - w.axis_u * f64::dot(across, w.axis_u));
  w.r_u = e.r_u, w.r_v = e.r_v, w.r_w = e.r_w;
  return w;
}

struct Worst {
  double form = 0, form_of_narrow = 0, form_in_float = 0;
};

// Largest quadratic form over the lobe's isosurface; and that of the same ellipsoid 2 % narrower across.
Worst worst_form(Bound bound, int lobes, int directions) {
  Dice dice(31 + bound);
  Worst worst;
  for (int i = 0; i < lobes; ++i) {
    TextbookLobe lobe = random_lobe(dice, 1e-3);
    const f32::real3 incident = rounded(lobe.incident);
    lobe.incident = f64::normalize(test::widened(incident));
    const auto e = bound_of(bound, f64::glossy_lobe({0, 0, 0}, {0, 0, 1}, lobe.incident, lobe.alpha), lobe);
    const auto in_float = widened(bound_in_float(bound, incident, lobe));
    auto narrow = e;
    narrow.r_w *= 0.98;
    for (int k = 0; k < directions; ++k) {
      const real3 out = outgoing_direction(dice, lobe);
      const real3 x = out * std::sqrt(lobe.intensity(out, true));
      worst.form = std::max(worst.form, f64::ellipsoid_form(e, x));
      worst.form_of_narrow = std::max(worst.form_of_narrow, f64::ellipsoid_form(narrow, x));
      worst.form_in_float = std::max(worst.form_in_float, f64::ellipsoid_form(in_float, x));
    }
  }
  return worst;
}

TEST(NarrowedEllipsoid, contains_the_lobe) {
  const Worst worst = worst_form(kNarrowed, 100000, 12);
  EXPECT_LE(worst.form, 1 + 1e-6);
  EXPECT_LE(worst.form_in_float, 1 + 1e-4);
  EXPECT_GT(worst.form_of_narrow, 1 + 1e-3) << "2 % too narrow is caught";
}

TEST(FittedEllipsoid, contains_the_lobe) {
  const Worst worst = worst_form(kFitted, 100000, 12);
  EXPECT_LE(worst.form, 1 + 1e-6);
  EXPECT_LE(worst.form_in_float, 1 + 1e-4);
  EXPECT_GT(worst.form_of_narrow, 1 + 1e-3) << "2 % too narrow is caught";
}

TEST(TightEllipsoid, contains_the_lobe) {
  const Worst worst = worst_form(kTight, 30000, 40);
  EXPECT_LE(worst.form, 1 + 1e-6);
  EXPECT_LE(worst.form_in_float, 1 + 1e-4);
  EXPECT_GT(worst.form_of_narrow, 1 + 1e-3) << "2 % too narrow is caught";
}

// Mean over cos(theta_i) of the volume over that of the spheroid.
double mean_volume(Bound bound, double alpha, double f0, int cosines) {
  double sum = 0;
  for (int i = 0; i < cosines; ++i) {
    TextbookLobe lobe{{0, 0, (i + 0.5) / cosines}, alpha, f0, 1};
    lobe.incident.x = std::sqrt(1 - lobe.incident.z * lobe.incident.z);
    const auto glossy = f64::glossy_lobe({0, 0, 0}, {0, 0, 1}, lobe.incident, alpha);
    const auto e = bound_of(bound, glossy, lobe);
    const auto spheroid = f64::bounding_spheroid(glossy, f64::lobe_size(glossy, f0, 1, 1));
    sum += e.r_u * e.r_v * e.r_w / (spheroid.r_u * spheroid.r_v * spheroid.r_w);
  }
  return sum / cosines;
}

TEST(FittedEllipsoid, has_the_volume_that_its_derivation_predicts) {
  const std::array<std::pair<double, double>, 4> expected = {{{.05, .536}, {.1, .574}, {.2, .654}, {.4, .804}}};
  for (const auto& [alpha, volume] : expected) {
    EXPECT_NEAR(mean_volume(kFitted, alpha, 1, 10000), volume, 0.005) << alpha;
    EXPECT_GT(mean_volume(kNarrowed, alpha, 1, 10000), volume + 0.01) << "the narrowed ellipsoid is larger";
  }
}

TEST(TightEllipsoid, is_a_third_of_the_spheroid_for_dielectrics_and_never_larger_than_the_fitted_one) {
  for (double alpha : {.05, .1, .2, .4, 1.0}) {
    EXPECT_LT(mean_volume(kTight, alpha, .04, 400), .31) << alpha;
    EXPECT_GT(mean_volume(kTight, alpha, .04, 400), .05) << alpha;  // the true region's share
    for (double f0 : {.04, .5, 1.0}) {
      EXPECT_LE(mean_volume(kTight, alpha, f0, 100), mean_volume(kFitted, alpha, f0, 100) * (1 + 1e-9));
    }
  }
}

// Any zeta above alpha^2/(4+alpha^2) is a bound: the closed form must stay above.
TEST(FittedZeta, stays_where_the_bound_is_proven) {
  Dice dice(35);
  for (int i = 0; i < 1000000; ++i) {
    const real alpha = dice.log_uniform(1e-3, 1), c = dice.log_uniform(1e-6, 1);
    const real zeta = f64::fitted_zeta(alpha, c * c, 1 - c * c);
    ASSERT_GT(zeta, alpha * alpha / (4 + alpha * alpha));
    ASSERT_LE(zeta, 1.0);
  }
  EXPECT_LT(f64::fitted_zeta(0.1, 1e-8, 1), 0.02) << "far from the trivial 1 at grazing incidence";
}

// Chord and tangent must bound F G2/G1 in every cell; the same with masking at the lower end instead does not.
TEST(FresnelMaskingBound, bounds_the_product_in_its_cell) {
  Dice dice(36);
  double largest = 0, loosest = 0;
  for (int i = 0; i < 200000; ++i) {
    const TextbookLobe lobe = random_lobe(dice, 1e-2);
    const real3 out = outgoing_direction(dice, lobe);
    const real3 h = f64::normalize(lobe.incident + out);
    const real theta = std::acos(std::min(1.0, h.z)), first = theta * dice.uniform(0.8, 1);
    const real last = theta + (std::acos(-1.0) / 2 - theta) * dice.uniform(0, 0.1);
    const f64::MicrofacetCell cell{std::cos(first), std::sin(first), std::cos(last), std::sin(last)};
    const auto glossy = f64::glossy_lobe({0, 0, 0}, {0, 0, 1}, lobe.incident, lobe.alpha);
    const real c = lobe.incident.z, masking = std::sqrt(lobe.alpha * lobe.alpha * (1 - c * c) + c * c);
    const real bound = f64::fresnel_masking_bound(glossy, lobe.f0, lobe.f90, masking, cell);
    const real li = lobe.lambda(c), lo = lobe.lambda(out.z);
    const real truth = lobe.fresnel(out) * (1 + li) / (1 + li + lo);
    largest = std::max(largest, truth / bound);
    loosest = std::max(loosest, bound);
  }
  EXPECT_LE(largest, 1.0);
  EXPECT_GT(largest, 0.9) << "the bound says something";
  EXPECT_LE(loosest, 1.1);
}

}  // namespace luciole::test
