// SPDX-License-Identifier: Apache-2.0
// Triangular factor, boxes and the exact distance; tile_pairs_test.cpp has the millions of pairs.
#include <algorithm>
#include <array>

#include "equations/tile_test_support.h"

namespace luciole::test {

TEST(TriangularFactor, squares_to_the_quadratic_form) {
  Dice dice(41);
  double worst = 0, worst_float = 0, worst_transposed = 0;
  for (int i = 0; i < 200000; ++i) {
    const f64::BoundingEllipsoid e = random_ellipsoid(dice, {0, 0, 0}, 5e-3);
    const real3 v = f64::cross(e.axis_w, e.axis_u), inverse(1 / e.r_u, 1 / e.r_v, 1 / e.r_w);
    const auto m = f64::triangular_factor(e.axis_u, v, e.axis_w, inverse);
    const auto mf = f32::triangular_factor(rounded(e.axis_u), rounded(v), rounded(e.axis_w), rounded(inverse));
    const real3 d = dice.direction();
    const real3 md(m.m00 * d.x + m.m01 * d.y + m.m02 * d.z, m.m11 * d.y + m.m12 * d.z, m.m22 * d.z);
    const real3 mtd(m.m00 * d.x, m.m01 * d.x + m.m11 * d.y, m.m02 * d.x + m.m12 * d.y + m.m22 * d.z);
    const double form = f64::ellipsoid_form(e, d);
    worst = std::max(worst, std::abs(f64::dot(md, md) / form - 1));
    worst_transposed = std::max(worst_transposed, std::abs(f64::dot(mtd, mtd) / form - 1));
    const double largest = std::max({m.m00, std::abs(m.m01), std::abs(m.m02), m.m11, std::abs(m.m12), m.m22});
    for (double difference :
         {m.m00 - mf.m00, m.m01 - mf.m01, m.m02 - mf.m02, m.m11 - mf.m11, m.m12 - mf.m12, m.m22 - mf.m22})
      worst_float = std::max(worst_float, std::abs(difference) / largest);
  }
  EXPECT_LT(worst, 1e-8);  // relative to the form itself, which cancels along the long axis
  EXPECT_LT(worst_float, 1e-4);
  EXPECT_GT(worst_transposed, 0.5) << "M M^T instead of M^T M is caught";
}

TEST(TriangularFactor, is_the_papers_matrix_up_to_the_order_of_x_and_y) {
  Dice dice(42);
  const f64::ViewFrame identity{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  int x_first = 0;
  for (int i = 0; i < 10000; ++i) {
    const f64::BoundingEllipsoid e = random_ellipsoid(dice, {0, 0, 0}, 0.05);
    const auto paper = f64::prepare_ellipsoid_as_paper(identity, e);
    const auto m = f64::prepare_ellipsoid(identity, e, f64::SurfacePlane{}).factor;
    EXPECT_NEAR(paper.row_z.x, 0, 1e-9 * std::abs(paper.row_z.z));
    EXPECT_NEAR(paper.row_z.y, 0, 1e-9 * std::abs(paper.row_z.z));
    EXPECT_NEAR(std::abs(paper.row_z.z), m.m22, 1e-9 * m.m22);
    if (std::abs(paper.row_y.x) < 1e-9 * m.m00) {
      ++x_first;
      EXPECT_NEAR(paper.row_x.x, m.m00, 1e-9 * m.m00);
      EXPECT_NEAR(paper.row_y.y, m.m11, 1e-9 * m.m11);
    } else {
      EXPECT_NEAR(paper.row_x.y, 0, 1e-9 * m.m00) << "otherwise x is free of y";
    }
  }
  EXPECT_GT(x_first, 2000);
  EXPECT_LT(x_first, 8000);
}

// Box of the 8 corners in the stretched space by brute force.
double corner_box_distance_sq(const f64::TileTestEllipsoid& t, const f64::Tile& tile) {
  real3 low(1e30, 1e30, 1e30), high(-1e30, -1e30, -1e30);
  for (const real3& corner : stretched_corners(t, tile)) low = f64::min(low, corner), high = f64::max(high, corner);
  const real3 gap = f64::max(f64::max(low, -high), real3(0, 0, 0));
  return f64::dot(gap, gap);
}

TEST(StretchedDistance, is_that_of_the_box_around_the_eight_corners) {
  Dice dice(43);
  int apart = 0;
  for (int i = 0; i < 200000; ++i) {
    const f64::Tile tile = random_tile(dice);
    const auto t =
        f64::prepare_ellipsoid(kEye, random_ellipsoid(dice, point_near(dice, tile), 0.01), f64::SurfacePlane{});
    const double expected = corner_box_distance_sq(t, tile);
    ASSERT_NEAR(box_distance_sq(t, tile), expected, 1e-9 * (1 + expected));
    apart += expected > 1 ? 1 : 0;
  }
  EXPECT_GT(apart, 1000);
}

// Gilbert's iteration: the point of least norm in a convex hull, with rigorous bounds from below and above.
std::pair<double, double> hull_distance(const std::array<real3, 8>& corners) {
  real3 x = corners[0];
  double lower = 0;
  for (int i = 0; i < 4000; ++i) {
    const real3* best = &corners[0];
    for (const real3& c : corners)
      if (f64::dot(c, x) < f64::dot(*best, x)) best = &c;
    const double norm = f64::length(x);
    if (norm == 0) return {0, 0};
    lower = std::max(lower, f64::dot(*best, x) / norm);
    const real3 d = *best - x;
    const double dd = f64::dot(d, d);
    if (dd == 0) break;
    x += d * std::clamp(-f64::dot(x, d) / dd, 0.0, 1.0);
  }
  return {lower, f64::length(x)};
}

TEST(ExactDistance, lies_between_the_bounds_of_an_independent_solver) {
  Dice dice(44);
  int sharp = 0, apart = 0;
  for (int i = 0; i < 3000; ++i) {
    const f64::Tile tile = random_tile(dice);
    const auto t =
        f64::prepare_ellipsoid(kEye, random_ellipsoid(dice, point_near(dice, tile), 0.1), f64::SurfacePlane{});
    const double exact = std::sqrt(f64::exact_distance_sq(t, tile, tile.near_low, tile.near_high));
    const auto [lower, upper] = hull_distance(stretched_corners(t, tile));
    ASSERT_GE(exact, lower * (1 - 1e-9));
    ASSERT_LE(exact, upper * (1 + 1e-9) + 1e-9);
    if (exact > 0.1) ++apart, sharp += upper - lower < 0.02 * upper;
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(sharp, 0.8 * apart) << "the solver says something";
}

TEST(SurfacePlane, rejects_tiles_wholly_below_the_light) {
  const f64::Tile tile{-0.1, 0.1, -0.1, 0.1, 4, 5, 6, 7};
  f64::TileTestSphere sphere;
  sphere.centre = {0, 0, 5.5};
  sphere.radius_sq = 100;
  const auto test = [&](real3 position, real3 normal) {
    sphere.surface = f64::surface_plane(kEye, position, normal);
    return f64::sphere_touches_tile(sphere, tile);
  };
  EXPECT_TRUE(test({0, 0, 4.5}, {0, 0, 1}).near_half);  // looks away from the eye, in the middle of the near half
  EXPECT_TRUE(test({0, 0, 4.5}, {0, 0, 1}).far_half);
  EXPECT_FALSE(test({0, 0, 5.5}, {0, 0, 1}).near_half);  // behind all surfaces of the near half
  EXPECT_TRUE(test({0, 0, 5.5}, {0, 0, 0}).near_half);   // no plane
  EXPECT_FALSE(test({0, 3, 4.5}, {0, 1, 0}).near_half);
}

TEST(EmptyHalf, touches_nothing) {
  f64::Tile tile{-1, 1, -1, 1, 4, 5, 1e30, -1};
  const auto plane = f64::surface_plane(kEye, {0, 0, 4}, {0, 0, 0});
  const f64::BoundingEllipsoid e = {{0, 0, 4.5}, {1, 0, 0}, {0, 1, 0}, 100, 100, 100};
  EXPECT_TRUE(f64::ellipsoid_touches_tile(f64::prepare_ellipsoid(kEye, e, plane), tile).near_half);
  EXPECT_FALSE(f64::ellipsoid_touches_tile(f64::prepare_ellipsoid(kEye, e, plane), tile).far_half);
  EXPECT_FALSE(f64::touches_tile_as_paper(f64::prepare_ellipsoid_as_paper(kEye, e), tile).far_half);
  EXPECT_FALSE(f64::ellipsoid_touches_tile_exactly(f64::prepare_ellipsoid(kEye, e, plane), tile).far_half);
}

TEST(DepthMask, never_loses_a_surface_inside_a_lights_range) {
  Dice dice(45);
  int disjoint = 0;
  for (int i = 0; i < 200000; ++i) {
    const float low = static_cast<float>(dice.uniform(0.1, 10)),
                high = low + static_cast<float>(dice.log_uniform(1e-5, 50));
    const auto slices = f32::depth_slices(low, high);
    const float surface = low + static_cast<float>(dice.uniform()) * (high - low);
    const float light_low = surface - static_cast<float>(dice.log_uniform(1e-6, 10));
    const float light_high = surface + static_cast<float>(dice.log_uniform(1e-6, 10));
    ASSERT_NE(f32::range_depth_mask(slices, light_low, light_high) & f32::surface_depth_mask(slices, surface), 0u);
    const float elsewhere = low + static_cast<float>(dice.uniform()) * (high - low);
    disjoint +=
        (f32::range_depth_mask(slices, light_low, light_high) & f32::surface_depth_mask(slices, elsewhere)) == 0;
  }
  EXPECT_GT(disjoint, 10000) << "and it does separate";
  EXPECT_EQ(f32::range_depth_mask(f32::depth_slices(0, 32), 3.5f, 5.5f), 0x38u);
}

}  // namespace luciole::test
