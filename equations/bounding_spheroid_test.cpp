// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "equations/test_support.h"

namespace luciole::test {

using f64::real;

f64::GlossyLobe glossy_lobe_of(const TextbookLobe& lobe, real3 position) {
  return f64::glossy_lobe(position, {0, 0, 1}, lobe.incident, lobe.alpha);
}

struct Extremes {
  double ratio = 0;                 // l_max / s
  double form = 0;                  // of the spheroid at l_max
  double form_of_short = 0;         // of a spheroid 1 % too small
  double ratio_normal_fresnel = 0;  // with f0 for F_max
  int lost = 0;                     // by spheroid_contains
};

Extremes extremes(bool correlated) {
  Dice dice(correlated ? 21 : 22);
  Extremes worst;
  for (int i = 0; i < 1000000; ++i) {
    const TextbookLobe lobe = random_lobe(dice, 1e-3);
    const real3 out = outgoing_direction(dice, lobe);
    const auto glossy = glossy_lobe_of(lobe, {0, 0, 0});
    const real size = f64::lobe_size(glossy, lobe.f0, lobe.f90, 1.0);
    const real l = std::sqrt(lobe.intensity(out, correlated));
    // s = r sqrt(pi D(cos theta/2)) = 2 r alpha / (alpha^2 |w_o + w_u|^2/2 + |w_o - w_u|^2/2)
    const real3 sum = out + glossy.mirror, difference = out - glossy.mirror;
    const real s =
        4 * size * lobe.alpha / (lobe.alpha * lobe.alpha * f64::dot(sum, sum) + f64::dot(difference, difference));
    worst.ratio = std::max(worst.ratio, l / s);
    worst.ratio_normal_fresnel = std::max(
        worst.ratio_normal_fresnel,
        l / s * std::sqrt(f64::largest_fresnel(lobe.f0, lobe.f90, glossy.cos_incident, glossy.sin_incident) / lobe.f0));
    worst.form = std::max(worst.form, f64::ellipsoid_form(f64::bounding_spheroid(glossy, size), out * l));
    worst.form_of_short =
        std::max(worst.form_of_short, f64::ellipsoid_form(f64::bounding_spheroid(glossy, size * 0.99), out * l));
    worst.lost += f64::spheroid_contains(glossy, size * (1 + 1e-9), out * l) ? 0 : 1;
  }
  return worst;
}

TEST(BoundingSpheroid, contains_all_that_the_lobe_reaches) {
  for (bool correlated : {false, true}) {
    const Extremes worst = extremes(correlated);
    EXPECT_LE(worst.ratio, 1 + 1e-6);
    EXPECT_LE(worst.form, 1 + 1e-6);
    EXPECT_EQ(worst.lost, 0);
    EXPECT_GT(worst.form_of_short, 1.001) << "a spheroid 1 % too small is caught";
    EXPECT_GT(worst.ratio_normal_fresnel, 1.1) << "Fresnel at normal incidence instead of its maximum is caught";
  }
}

TEST(BoundingSpheroid, is_tight_at_the_tip_of_a_sharp_metal_lobe) {
  const TextbookLobe lobe{{0.6, 0, 0.8}, 1e-3, 1, 1};
  const auto glossy = glossy_lobe_of(lobe, {0, 0, 0});
  const real size = f64::lobe_size(glossy, 1, 1, 1);
  const real l = std::sqrt(lobe.intensity({-0.6, 0, 0.8}, true));
  EXPECT_GT(l / f64::glossy_reach(glossy, size), 0.9999);
  EXPECT_LE(l / f64::glossy_reach(glossy, size), 1.0 + 1e-9);
  EXPECT_LT(l / f64::glossy_reach(glossy, size * 1.01), 0.9999);
}

TEST(BoundingSpheroid, reaches_from_minus_alpha_r_to_r_over_alpha_with_the_light_in_a_focus) {
  for (real alpha : {1e-3, 0.1, 1.0}) {
    const auto glossy = f64::glossy_lobe({1, 2, 3}, {0, 0, 1}, f64::normalize(real3(1, 0, 2)), alpha);
    const auto e = f64::bounding_spheroid(glossy, 0.7);
    const real along = f64::dot(e.centre - glossy.position, glossy.mirror);
    EXPECT_NEAR(along - e.r_u, -alpha * 0.7, 1e-12 * e.r_u);
    EXPECT_NEAR(along + e.r_u, 0.7 / alpha, 1e-12 * e.r_u);
    EXPECT_NEAR(along, std::sqrt(e.r_u * e.r_u - e.r_v * e.r_v), 1e-9 * e.r_u);  // focal distance
  }
}

// Definition of r^2, [TH17] Eq. 12, with G1 and the division by c.
real size_sq_by_definition(real c, real alpha, real f0, real flux_per_threshold) {
  const real f_max = f64::largest_fresnel(f0, 1, c, std::sqrt(1 - c * c));
  return flux_per_threshold * f_max * f64::smith_masking(alpha * alpha, c) / (4 * kPi * c);
}

TEST(LobeSize, is_finite_at_grazing_incidence_and_equals_its_definition_elsewhere) {
  for (real c : {1.0, 1e-2, 1e-4, 0.0})
    for (real alpha : {1e-3, 0.1, 1.0}) {
      f64::GlossyLobe lobe;
      lobe.cos_incident = c, lobe.sin_incident = std::sqrt(1 - c * c), lobe.alpha = alpha;
      f32::GlossyLobe in_float;
      in_float.cos_incident = static_cast<float>(c), in_float.sin_incident = static_cast<float>(lobe.sin_incident);
      in_float.alpha = static_cast<float>(alpha);
      const real size = f64::lobe_size(lobe, 0.04, 1, 5);
      EXPECT_TRUE(std::isfinite(size) && size > 0);
      EXPECT_NEAR(f32::lobe_size(in_float, 0.04f, 1, 5), size, 1e-6 * size);
      if (c > 0) {
        const real expected = size_sq_by_definition(c, alpha, 0.04, 5);
        EXPECT_NEAR(size * size, expected, 1e-10 * expected);
      }
    }
  EXPECT_FALSE(std::isfinite(size_sq_by_definition(0, 0.1, 0.04, 5))) << "the paper's form divides by c";
}

TEST(SpheroidContains, survives_float_where_the_dot_product_form_does_not) {
  Dice dice(23);
  double worst = 0, worst_naive = 0;
  for (int i = 0; i < 300000; ++i) {
    TextbookLobe lobe = random_lobe(dice, 1e-3);
    const f32::real3 incident = rounded(lobe.incident);
    lobe.incident = f64::normalize(widened(incident));
    const auto glossy = f32::glossy_lobe({0, 0, 0}, {0, 0, 1}, incident, static_cast<float>(lobe.alpha));
    const float size = f32::lobe_size(glossy, static_cast<float>(lobe.f0), static_cast<float>(lobe.f90), 1);
    const real3 out = outgoing_direction(dice, lobe);
    const f32::real3 p = rounded(out * std::sqrt(lobe.intensity(out, true)));
    const float l = f32::length(p), alpha_sq = glossy.alpha * glossy.alpha, limit = 2 * size * glossy.alpha;
    const float naive = (1 + alpha_sq) * l - (1 - alpha_sq) * f32::dot(p, glossy.mirror);
    worst_naive = std::max<double>(worst_naive, naive / limit);
    worst += f32::spheroid_contains(glossy, size * 1.0001f, p) ? 0 : 1;
  }
  EXPECT_EQ(worst, 0.0);
  EXPECT_GT(worst_naive, 1.01) << "the difference of two long terms loses lit points";
}

TEST(DiffuseBoundingSphere, touches_the_lobe_at_the_inverse_square_root_of_three) {
  const real reach = f64::diffuse_reach(17.0);
  const auto sphere = f64::diffuse_bounding_sphere({0, 0, 0}, {0, 0, 1}, reach);
  real largest = 0, at = 0, at_light = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const real c = i * 1e-6, l = reach * std::sqrt(c);
    const real3 x(l * std::sqrt(1 - c * c), 0, l * c);
    const real ratio = f64::length(x - sphere.centre) / sphere.radius;
    if (ratio > largest) largest = ratio, at = c;
    at_light = std::max(at_light, f64::length(x) / sphere.radius);
  }
  EXPECT_LE(largest, 1 + 1e-12);
  EXPECT_GE(largest, 1 - 1e-6);
  EXPECT_NEAR(at, 0.57735, 1e-3);
  EXPECT_GT(at_light, 1.5) << "the same sphere around the light itself is caught";
}

TEST(BoundingSpheres, contain_the_spheroid) {
  Dice dice(24);
  for (int i = 0; i < 1000; ++i) {
    const TextbookLobe lobe = random_lobe(dice, 1e-2);
    const auto glossy = glossy_lobe_of(lobe, {1, 2, 3});
    const real size = f64::lobe_size(glossy, lobe.f0, lobe.f90, 2);
    const auto e = f64::bounding_spheroid(glossy, size);
    const auto around = f64::sphere_around(e),
               at_light = f64::sphere_at_light({1, 2, 3}, f64::glossy_reach(glossy, size));
    const real3 d = dice.direction(), v = f64::cross(e.axis_w, e.axis_u);
    const real3 x = e.centre + e.axis_u * (d.x * e.r_u) + v * (d.y * e.r_v) + e.axis_w * (d.z * e.r_w);
    EXPECT_LE(f64::length(x - around.centre), around.radius * (1 + 1e-9));
    EXPECT_LE(f64::length(x - at_light.centre), at_light.radius * (1 + 1e-9));
    EXPECT_GT(f64::length(e.centre + e.axis_u * e.r_u - at_light.centre), at_light.radius * 0.99);
  }
}

TEST(BoundingF0, bounds_each_channel_of_a_coloured_lobe) {
  Dice dice(25);
  for (int i = 0; i < 10000; ++i) {
    const real3 flux(dice.uniform(), dice.uniform(), dice.uniform()),
        f0(dice.uniform(), dice.uniform(), dice.uniform());
    const real f = f64::bounding_f0(flux, f0), peak = f64::largest_channel(flux);
    for (real w : {0.0, 0.3, 1.0}) {
      const real3 reflected = flux * (f0 * (1 - w) + real3(w, w, w));
      EXPECT_LE(f64::largest_channel(reflected), peak * (f * (1 - w) + w) * (1 + 1e-12));
    }
    EXPECT_LE(f, f64::largest_channel(f0) * (1 + 1e-12));
    EXPECT_DOUBLE_EQ(f64::largest_channel(flux * f0), peak * f) << "exact at normal incidence";
  }
}

TEST(GlossyLobe, has_an_orthonormal_frame_in_float_for_every_incidence) {
  Dice dice(26);
  for (int i = 0; i < 100000; ++i) {
    const real3 n = dice.direction();
    real3 w = f64::normalize(n + dice.direction() * dice.log_uniform(1e-7, 1));
    const auto lobe = f32::glossy_lobe({0, 0, 0}, rounded(n), rounded(w), 0.1f);
    ASSERT_NEAR(f32::dot(lobe.across, lobe.mirror), 0, 3e-7);
    ASSERT_NEAR(f32::length(lobe.across), 1, 1e-6);
    ASSERT_NEAR(f32::length(lobe.mirror), 1, 1e-6);
  }
}

}  // namespace luciole::test
