// SPDX-License-Identifier: Apache-2.0
// Millions of pairs of a light's bound and a tile: none that touches may be lost, and few that do not may stay.
#include <algorithm>

#include "equations/tile_test_support.h"

namespace luciole::test {

// The ellipsoid grown or shrunk about its centre by `scale`, without the tolerance of its side planes.
f64::TileTestEllipsoid scaled(f64::TileTestEllipsoid t, double scale, double side_scale_sq) {
  for (double* entry : {&t.factor.m00, &t.factor.m01, &t.factor.m02, &t.factor.m11, &t.factor.m12, &t.factor.m22})
    *entry /= scale;
  t.stretched = t.stretched / scale;
  const double edge_on = 2e-6 * (t.sxx + t.syy + t.szz) / (1.001 + 3 * 2e-6);
  for (double* entry : {&t.sxx, &t.syy, &t.szz}) *entry -= edge_on;
  for (double* entry : {&t.sxx, &t.sxz, &t.syy, &t.syz, &t.szz}) *entry *= side_scale_sq / 1.001;
  return t;
}

TEST(TileTests, lose_no_pair_that_just_touches) {
  Dice dice(51);
  int pairs = 0, lost = 0, lost_by_paper = 0, lost_when_shrunk = 0;
  while (pairs < 1000000) {
    const f64::Tile tile = random_tile(dice);
    const f64::BoundingEllipsoid e = random_ellipsoid(dice, point_near(dice, tile), 1e-3);
    const auto t = f64::prepare_ellipsoid(kEye, e, f64::surface_plane(kEye, {0, 0, 1}, {0, 0, 0}));
    const double d_sq = f64::exact_distance_sq(t, tile, tile.near_low, tile.near_high);
    if (!(d_sq > 1e-6)) continue;  // the centre is inside
    ++pairs;
    // Scaled so that the stretched distance is the tests' limit, less 1e-9.
    const double d = std::sqrt(d_sq);
    const auto touching = scaled(t, d / std::sqrt(1.0002) * (1 + 1e-9), d_sq * (1 + 2e-9));
    lost += f64::ellipsoid_touches_tile(touching, tile).near_half ? 0 : 1;
    const auto shrunk = scaled(t, d / 1.03, d_sq / 1.06);
    lost_when_shrunk += f64::ellipsoid_touches_tile(shrunk, tile).near_half ? 0 : 1;
    auto paper = f64::prepare_ellipsoid_as_paper(kEye, e);
    const double grow = std::sqrt(1.0002) / d * (1 - 1e-9);
    paper.row_x = paper.row_x * grow, paper.row_y = paper.row_y * grow, paper.row_z = paper.row_z * grow;
    paper.stretched = paper.stretched * grow;
    lost_by_paper += f64::touches_tile_as_paper(paper, tile).near_half ? 0 : 1;
  }
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(lost_by_paper, 0);
  EXPECT_GT(lost_when_shrunk, 100000) << "ellipsoids 3 % too small lose pairs";
}

template <class Ellipsoid>
bool touches(const f32::ViewFrame& view, const Ellipsoid& e, const f32::SurfacePlane& plane, const f32::Tile& tile) {
  return f32::ellipsoid_touches_tile(f32::prepare_ellipsoid(view, e, plane), tile).near_half;
}

// A tile of random size around a point, which often lies on its edge; the point's depth is an end of the range.
f32::Tile tile_around(Dice& dice, f32::real3 p) {
  const float width = static_cast<float>(dice.log_uniform(1e-3, 0.3)), x = p.x / p.z, y = p.y / p.z;
  const auto share = [&] { return dice.uniform() < 0.4 ? 0.0f : static_cast<float>(dice.uniform()); };
  f32::Tile tile;
  tile.x_low = x - width * share(), tile.x_high = std::max(x, tile.x_low + width);
  tile.y_low = y - width * share(), tile.y_high = std::max(y, tile.y_low + width);
  const float thickness = p.z * static_cast<float>(dice.log_uniform(1e-5, 0.5));
  const bool at_low = dice.uniform() < 0.5;
  tile.near_low = at_low ? p.z : std::max(1e-3f, p.z - thickness), tile.near_high = at_low ? p.z + thickness : p.z;
  tile.far_low = 1e30f, tile.far_high = -1;
  return tile;
}

struct LostLights {
  int pairs = 0;
  int spheroid = 0, fitted = 0, tight = 0, paper = 0, exact = 0, sphere = 0;  // true hits that the bound's test denies
  int short_range = 0;                                                        // by a bound whose flux is 3 % too low
};

// Does the shading kernel accept the light at `target`, in float?
bool kernel_accepts(const TextbookLobe& lobe, f32::real3 position, f32::real3 incident, f32::real3 target, float flux) {
  f32::SurfaceBrdf brdf;
  const float f0 = static_cast<float>(lobe.f0);
  brdf.f0 = {f0, f0, f0};
  brdf.f90 = static_cast<float>(lobe.f90);
  brdf.ggx_alpha = static_cast<float>(lobe.alpha);
  const f32::real3 d = target - position;
  const float distance_sq = f32::dot(d, d);
  const auto fixed = f32::fix_direction(brdf, {0, 0, 1}, incident);
  const f32::real3 intensity = f32::glossy_lobe_intensity(fixed, {flux, flux, flux}, d / std::sqrt(distance_sq));
  return f32::light_is_accepted(f32::display_intensity(intensity, 1), 1, distance_sq, 1);
}

// One point where the light is accepted, half of them within .3 % of the end of its range, against all bounds.
void count_lost(Dice& dice, LostLights& lost) {
  TextbookLobe lobe = random_lobe(dice, 1e-3);
  const f64::ViewFrame view = random_view(dice, real3(dice.uniform(-9, 9), dice.uniform(-9, 9), dice.uniform(-9, 9)));
  const f32::ViewFrame eye = rounded(view);
  const f32::real3 position = rounded(real3(dice.uniform(-5, 5), dice.uniform(-5, 5), dice.uniform(-5, 5)));
  const f32::real3 incident = rounded(lobe.incident), normal(0, 0, 1);
  lobe.incident = f64::normalize(widened(incident));
  const float flux_float = static_cast<float>(dice.log_uniform(1e-2, 1e2));
  const real3 out = outgoing_direction(dice, lobe);
  const double reach = dice.uniform() < 0.5 ? dice.uniform(0.997, 1.003) : std::sqrt(dice.uniform());
  const double range = std::sqrt(flux_float * lobe.intensity(out, true));
  const f32::real3 target = rounded(widened(position) + out * (reach * range));
  const f32::real3 in_view = f32::view_from_world(eye, target);
  if (in_view.z < 0.05f || target.z <= position.z) return;
  if (!kernel_accepts(lobe, position, incident, target, flux_float)) return;
  ++lost.pairs;
  const f32::Tile tile = tile_around(dice, in_view);
  const float alpha = static_cast<float>(lobe.alpha), f0 = static_cast<float>(lobe.f0),
              f90 = static_cast<float>(lobe.f90);
  const auto glossy = f32::glossy_lobe(position, normal, incident, alpha);
  const float size = f32::lobe_size(glossy, f0, f90, flux_float);
  const auto plane = f32::surface_plane(eye, position, normal);
  const auto spheroid = f32::bounding_spheroid(glossy, size);
  const auto tight = f32::tight_ellipsoid(glossy, f0, f90, flux_float);
  lost.spheroid += !touches(eye, spheroid, plane, tile);
  lost.fitted += !touches(eye, f32::fitted_ellipsoid(glossy, size), plane, tile);
  lost.tight += !touches(eye, tight, plane, tile);
  lost.paper += !f32::touches_tile_as_paper(f32::prepare_ellipsoid_as_paper(eye, spheroid), tile).near_half;
  lost.exact += !f32::ellipsoid_touches_tile_exactly(f32::prepare_ellipsoid(eye, tight, plane), tile).near_half;
  lost.sphere +=
      !f32::sphere_touches_tile(f32::prepare_sphere(eye, f32::sphere_around(spheroid), plane), tile).near_half;
  lost.short_range += !touches(eye, f32::tight_ellipsoid(glossy, f0, f90, flux_float * 0.97f), plane, tile);
}

TEST(TileTests, in_float_lose_no_light_that_the_kernel_accepts) {
  Dice dice(52);
  LostLights lost;
  while (lost.pairs < 1000000) count_lost(dice, lost);
  EXPECT_EQ(lost.spheroid, 0);
  EXPECT_EQ(lost.fitted, 0);
  EXPECT_EQ(lost.tight, 0);
  EXPECT_EQ(lost.paper, 0);
  EXPECT_EQ(lost.exact, 0);
  EXPECT_EQ(lost.sphere, 0);
  EXPECT_GT(lost.short_range, 100) << "ranges 1.5 % short are caught";
}

// Pairs that a test accepts over those that truly touch, for spheroids of one roughness.
struct Efficiency {
  double ours = 0, box_only = 0, paper = 0;
};
Efficiency accepted_per_hit(double alpha) {
  Dice dice(53);
  double hits = 0, ours = 0, box = 0, paper = 0;
  for (int i = 0; i < 400000; ++i) {
    f64::Tile tile = random_tile(dice);
    tile.near_low = dice.uniform(3, 15), tile.near_high = tile.near_low * (1 + dice.log_uniform(0.01, 0.3));
    tile.far_low = 1e30, tile.far_high = -1;
    f64::BoundingEllipsoid e =
        random_ellipsoid(dice, {dice.uniform(-9, 9), dice.uniform(-5, 5), dice.uniform(1, 20)}, 1);
    e.r_v = e.r_w = std::cbrt(0.125 * 2 * alpha / (1 + alpha * alpha));  // equal volumes
    e.r_u = (1 + alpha * alpha) / (2 * alpha) * e.r_v;
    const auto t = f64::prepare_ellipsoid(kEye, e, f64::surface_plane(kEye, {0, 0, 1}, {0, 0, 0}));
    const bool in_box = box_distance_sq(t, tile) <= 1.0002;
    box += in_box;
    paper += f64::touches_tile_as_paper(f64::prepare_ellipsoid_as_paper(kEye, e), tile).near_half;
    ours += f64::ellipsoid_touches_tile(t, tile).near_half;
    if (in_box) hits += f64::ellipsoid_touches_tile_exactly(t, tile).near_half;
  }
  return {ours / hits, box / hits, paper / hits};
}

TEST(TileTests, accept_at_most_a_third_more_than_what_touches) {
  for (double alpha : {.05, .1, .2, .4, 1.0}) {
    const Efficiency e = accepted_per_hit(alpha);
    EXPECT_LE(e.ours, 1.3) << alpha;
    EXPECT_GE(e.ours, 1.0) << alpha;
    EXPECT_LE(e.ours, e.box_only);
    EXPECT_LE(e.ours, e.paper);
    RecordProperty("accepted_per_hit_" + std::to_string(alpha),
                   std::to_string(e.ours) + " paper " + std::to_string(e.paper));
    if (alpha < 0.06) {
      EXPECT_GT(e.box_only, 1.5) << "the box alone keeps what the side planes reject";
    }
  }
}

}  // namespace luciole::test
