// SPDX-License-Identifier: Apache-2.0
// The rivals lose no light: whatever lies in an ellipsoid lies in a cluster, or in a pixel, that its proxy covers.
#include "real_time/light_culling/proxy_kernel.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "base/isa.h"
#include "equations/test_support.h"
#include "equations/tile_test_support.h"

namespace luciole::test {
namespace {

constexpr std::uint32_t kColumns = 15, kRows = 9, kTiles = kColumns * kRows;

// A picture of 240 x 135 pixels, field of view 60 degrees, that shows surfaces in all parts of all tiles.
struct Screen {
  std::vector<std::uint32_t> occupied = std::vector<std::uint32_t>(kTiles, 0xffffffffu);
  std::vector<std::uint32_t> first = std::vector<std::uint32_t>(kTiles, 0u);
  TileBand band{};

  Screen() {
    const float side = 16 * 2 * std::tan(static_cast<float>(kPi) / 6) / 135;
    band.x_first = -0.5f * kColumns * side, band.x_step = side;
    band.y_first = 0.5f * 135 / 16 * side, band.y_step = -side;
    band.window = {0, kColumns, 0, kRows}, band.columns = kColumns;
    band.occupied = occupied.data(), band.first = first.data();
    band.slices = cluster_slices_between(0.5f, 60.0f);
  }
  f32::Tile cluster(std::uint32_t tile, std::uint32_t slice) const {
    const float column = static_cast<float>(tile % kColumns), row = static_cast<float>(tile / kColumns);
    f32::Tile t{};
    t.x_low = band.x_first + column * band.x_step, t.x_high = t.x_low + band.x_step;
    t.y_high = band.y_first + row * band.y_step, t.y_low = t.y_high + band.y_step;
    t.near_low = depth_of_slice(band.slices, slice), t.near_high = depth_of_slice(band.slices, slice + 1);
    t.far_low = 1, t.far_high = 0;
    return t;
  }
  // Tile coordinates with fractions.
  float column(real3 p) const { return (static_cast<float>(p.x / p.z) - band.x_first) / band.x_step; }
  float row(real3 p) const { return (static_cast<float>(p.y / p.z) - band.y_first) / band.y_step; }
  bool shows(real3 p) const {
    return p.z > 0.5 && p.z < 60 && column(p) > 0 && column(p) < kColumns && row(p) > 0 && row(p) < kRows;
  }
};

f64::BoundingEllipsoid ellipsoid_somewhere(Dice& dice) {
  const real3 seen(dice.uniform(-0.6, 0.6), dice.uniform(-0.6, 0.6), 1);
  return random_ellipsoid(dice, seen * dice.log_uniform(0.3, 60) + dice.direction() * dice.log_uniform(0.01, 10), 1e-3);
}

f64::BoundingEllipsoid in_float(const f64::BoundingEllipsoid& e) {
  f64::BoundingEllipsoid r = e;
  r.centre = widened(rounded(e.centre)), r.axis_u = widened(rounded(e.axis_u)), r.axis_w = widened(rounded(e.axis_w));
  return r;
}

real3 point_inside(Dice& dice, const f64::BoundingEllipsoid& e) {
  const real3 p = dice.direction() * (dice.uniform() < 0.5 ? 1.0 : std::cbrt(dice.uniform()));
  return e.centre + e.axis_u * (p.x * e.r_u) + f64::cross(e.axis_w, e.axis_u) * (p.y * e.r_v) +
         e.axis_w * (p.z * e.r_w);
}

f32::TileTestEllipsoid prepared(const f64::BoundingEllipsoid& e) {
  const f32::ViewFrame eye = rounded(kEye);
  f32::BoundingEllipsoid b;
  b.centre = rounded(e.centre), b.axis_u = rounded(e.axis_u), b.axis_w = rounded(e.axis_w);
  b.r_u = static_cast<float>(e.r_u), b.r_v = static_cast<float>(e.r_v), b.r_w = static_cast<float>(e.r_w);
  return f32::prepare_ellipsoid(eye, b, f32::surface_plane(eye, {0, 0, 1}, {0, 0, 0}));
}

// One light, in lane 0.
BoundBlock block_of(const f64::BoundingEllipsoid& e) {
  const f32::TileTestEllipsoid t = prepared(e);
  BoundBlock block{};
  for (float& radius : block.row[BoundBlock::kRadius]) radius = -1;
  const auto put = [&](int row, f32::real3 v) {
    block.row[row][0] = v.x, block.row[row + 1][0] = v.y, block.row[row + 2][0] = v.z;
  };
  put(BoundBlock::kCentreX, t.centre);
  block.row[BoundBlock::kRadius][0] = static_cast<float>(std::max({e.r_u, e.r_v, e.r_w}) * 1.001) + 1e-4f;
  put(BoundBlock::kM00, {t.factor.m00, t.factor.m01, t.factor.m02});
  put(BoundBlock::kM11, {t.factor.m11, t.factor.m12, t.factor.m22});
  put(BoundBlock::kStretchedX, t.stretched);
  block.row[BoundBlock::kNormalOffset][0] = -1;
  return block;
}

std::vector<Isa> instruction_sets() {
  std::vector<Isa> sets;
  for (Isa isa : {Isa::avx512, Isa::avx2, Isa::baseline})
    if (choose_isa(isa).has_value()) sets.push_back(isa);
  return sets;
}

// Per tile the slices that a light is assigned to.
std::vector<std::uint32_t> clusters_of(Isa isa, const Screen& screen, const BoundBlock& block,
                                       const IcosahedronProxy& proxy) {
  std::vector<LightSpan> spans(16 * kTiles);
  std::vector<float> low(kTiles), high(kTiles);
  std::uint64_t tests = 0;
  const std::uint32_t count = LUCIOLE_FOR_ISA(
      isa, cluster_lights(block, 0, screen.band, proxy, {low.data(), high.data()}, spans.data(), tests));
  std::vector<std::uint32_t> clusters(kTiles, 0u);
  for (std::uint32_t i = 0; i < count; ++i) clusters[spans[i].tile] = spans[i].parts;
  return clusters;
}

template <std::size_t n>
void shrink(float (&values)[n], float scale) {
  for (float& value : values) value *= scale;
}

IcosahedronProxy inscribed_icosahedron() {
  IcosahedronProxy proxy = circumscribed_icosahedron();
  const float scale = 1 / std::hypot(proxy.vertex[0][0], proxy.vertex[1][0], proxy.vertex[2][0]);
  for (int axis = 0; axis < 3; ++axis)
    shrink(proxy.vertex[axis], scale), shrink(proxy.edge_from[axis], scale), shrink(proxy.edge_to[axis], scale);
  proxy.distance *= scale;
  return proxy;
}

GeodesicProxy inscribed_geodesic() {
  GeodesicProxy proxy = circumscribed_geodesic();
  const float scale = 1 / std::hypot(proxy.corner[0][0][0], proxy.corner[0][1][0], proxy.corner[0][2][0]);
  for (auto& corner : proxy.corner)
    for (auto& axis : corner) shrink(axis, scale);
  shrink(proxy.distance, scale);
  return proxy;
}

int points_without_cluster(Isa isa, const IcosahedronProxy& proxy) {
  Dice dice(71);
  const Screen screen;
  int lost = 0;
  for (int light = 0; light < 4000; ++light) {
    const f64::BoundingEllipsoid e = in_float(ellipsoid_somewhere(dice));
    const std::vector<std::uint32_t> clusters = clusters_of(isa, screen, block_of(e), proxy);
    for (int i = 0; i < 50; ++i) {
      const real3 p = point_inside(dice, e);
      if (!screen.shows(p)) continue;
      const auto tile =
          static_cast<std::uint32_t>(screen.row(p)) * kColumns + static_cast<std::uint32_t>(screen.column(p));
      lost += (clusters[tile] >> cluster_slice_of(screen.band.slices, static_cast<float>(p.z)) & 1u) == 0;
    }
  }
  return lost;
}

TEST(Clusters, of_a_light_hold_all_points_of_its_ellipsoid) {
  for (const Isa isa : instruction_sets()) EXPECT_EQ(points_without_cluster(isa, circumscribed_icosahedron()), 0);
}

TEST(Clusters, of_an_inscribed_icosahedron_lose_points) {
  EXPECT_GT(points_without_cluster(Isa::baseline, inscribed_icosahedron()), 1000);
}

TEST(Clusters, are_those_of_an_exact_test_and_less_than_a_fifth_more) {
  Dice dice(72);
  const Screen screen;
  double touched = 0, assigned = 0, lost = 0;
  for (int light = 0; light < 300; ++light) {
    const f64::BoundingEllipsoid e = in_float(ellipsoid_somewhere(dice));
    const f32::TileTestEllipsoid exact = prepared(e);
    const std::vector<std::uint32_t> clusters =
        clusters_of(Isa::baseline, screen, block_of(e), circumscribed_icosahedron());
    for (std::uint32_t tile = 0; tile < kTiles; ++tile) {
      for (std::uint32_t slice = 0; slice < ClusterSlices::kCount; ++slice) {
        const f32::Tile t = screen.cluster(tile, slice);
        const bool touches = f32::exact_distance_sq(exact, t, t.near_low, t.near_high) <= 1.0f;
        const bool is_assigned = (clusters[tile] >> slice & 1u) != 0;
        touched += touches, assigned += is_assigned, lost += touches && !is_assigned;
      }
    }
  }
  EXPECT_EQ(lost, 0);
  EXPECT_LT(assigned / touched, 1.2);
  RecordProperty("candidates_over_exact", std::to_string(assigned / touched));
}

// How often a light covers a pixel whose surface is at `point`, in a picture that shows nothing else.
float covering(Isa isa, const BoundBlock& block, const GeodesicProxy& proxy, real3 point) {
  Screen screen;
  const auto column = static_cast<std::uint32_t>(4 * screen.column(point));
  const auto row = static_cast<std::uint32_t>(4 * screen.row(point));
  screen.occupied.assign(kTiles, 0u);
  screen.occupied[row / 4 * kColumns + column / 4] = 1u << (row % 4 * 4 + column % 4);
  screen.band.occupied = screen.occupied.data();
  constexpr int kLane = 5;
  CellPixels cell{};
  std::fill(cell.depth, cell.depth + kGroupPixels, std::numeric_limits<float>::quiet_NaN());
  cell.x[kLane] = static_cast<float>(point.x / point.z), cell.y[kLane] = static_cast<float>(point.y / point.z);
  cell.depth[kLane] = static_cast<float>(point.z);
  alignas(64) float counts[kGroupPixels] = {};
  std::vector<LightSpan> spans(16 * kTiles);
  std::uint64_t tests = 0;
  LUCIOLE_FOR_ISA(isa,
                  splat_lights(block, 0, screen.band, proxy, {&cell, &cell.depth[kLane]}, counts, spans.data(), tests));
  return counts[kLane];
}

int points_not_covered_once(Isa isa, const GeodesicProxy& proxy) {
  Dice dice(73);
  const Screen screen;
  int wrong = 0;
  for (int light = 0; light < 1000; ++light) {
    const f64::BoundingEllipsoid e = in_float(ellipsoid_somewhere(dice));
    const BoundBlock block = block_of(e);
    for (int i = 0; i < 20; ++i) {
      const real3 p = point_inside(dice, e);
      if (screen.shows(p)) wrong += covering(isa, block, proxy, p) != 1.0f;
    }
  }
  return wrong;
}

TEST(Splats, of_a_light_cover_each_pixel_inside_its_ellipsoid_once) {
  for (const Isa isa : instruction_sets()) EXPECT_EQ(points_not_covered_once(isa, circumscribed_geodesic()), 0);
}

TEST(Splats, of_an_inscribed_sphere_lose_pixels) {
  EXPECT_GT(points_not_covered_once(Isa::baseline, inscribed_geodesic()), 100);
}

TEST(Splats, end_where_the_back_of_the_proxy_is) {
  f64::BoundingEllipsoid e{{0.4, -0.3, 5}, {1, 0, 0}, {0, 1, 0}, 1, 1, 1};
  const auto at_depth = [&](double depth) {
    return covering(Isa::baseline, block_of(e), circumscribed_geodesic(), e.centre * (depth / 5));
  };
  EXPECT_EQ(at_depth(1), 1);  // only the back is drawn: what lies before the light cannot be told from what lies in it
  EXPECT_EQ(at_depth(5.9), 1);
  EXPECT_EQ(at_depth(6.2), 0);
  e.centre = {0, 0, 0.5};  // around the eye
  EXPECT_EQ(covering(Isa::baseline, block_of(e), circumscribed_geodesic(), {0.1, 0.1, 0.6}), 1);
}

}  // namespace
}  // namespace luciole::test
