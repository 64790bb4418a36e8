// SPDX-License-Identifier: Apache-2.0
#include "real_time/reflective_shadow_map/light_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "equations/cpp/float.h"

namespace luciole {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSigmas = 4;
constexpr std::uint32_t kCounts[] = {1, 2, 3, 7, 64, 1000, 65536};

Vec2 random_point(std::uint32_t seed, std::uint32_t index) {
  const f32::RandomWords words = f32::random_words(seed, 0, index, 0);
  return {f32::unit_real(words.first), f32::unit_real(words.second)};
}

PunctualLight spot(float cos_inner, float cos_outer) {
  PunctualLight light;
  light.kind = PunctualLight::Kind::spot;
  light.position = Vec3(1, 2, 3);
  light.direction = normalize(Vec3(0.3f, -1, 0.2f));
  light.intensity = Vec3(5, 5, 5);
  light.cos_inner = cos_inner, light.cos_outer = cos_outer;
  return light;
}

Bounds box(Vec3 low, Vec3 high) {
  Bounds bounds;
  bounds.grow(low), bounds.grow(high);
  return bounds;
}

const Bounds kHall = box(Vec3(-12, 0, -5), Vec3(11, 7, 6));

double summed_flux(const LightMap& map, const std::function<Vec2(std::uint32_t)>& within) {
  double sum = 0;
  for (std::uint32_t i = 0; i < map.size(); ++i) sum += static_cast<double>(map.ray(i, within(i)).flux.y);
  return sum;
}
Vec2 centre(std::uint32_t) { return {0.5f, 0.5f}; }

TEST(LightMap, flux_of_all_texels_is_the_power_where_intensity_is_constant) {
  PunctualLight point = spot(1, 0), sun = spot(1, 0);
  point.kind = PunctualLight::Kind::point;
  sun.kind = PunctualLight::Kind::directional;
  for (const PunctualLight& light : {point, sun, spot(0.7f, 0.7f), spot(0.9999f, 0.9999f)}) {
    const auto expected = static_cast<double>(power(light, kHall));
    for (const std::uint32_t n : kCounts) {
      // Each of n terms carries a few roundings of float.
      EXPECT_NEAR(summed_flux(LightMap(light, n, kHall), centre) / expected, 1, 2e-6) << n;
    }
  }
}

// z-score of the mean over many jittered maps against the integral over the cone.
double jittered_power_z(const std::function<double(const LightMap&, std::uint32_t)>& estimate, double expected) {
  const LightMap map(spot(0.95f, 0.6f), 60, kHall);
  constexpr int kMaps = 2000;
  double sum = 0, sum_sq = 0;
  for (std::uint32_t seed = 1; seed <= kMaps; ++seed) {
    const double flux = estimate(map, seed);
    sum += flux, sum_sq += flux * flux;
  }
  const double mean = sum / kMaps, variance = (sum_sq / kMaps - mean * mean) / kMaps;
  return (mean - expected) / std::sqrt(variance);
}

TEST(LightMap, jittered_texels_average_to_the_power_of_a_spot_with_a_soft_edge) {
  const double expected = 2 * kPi * 5 * (0.05 + 0.35 / 3);  // full cone, a third of the ramp
  EXPECT_NEAR(static_cast<double>(power(spot(0.95f, 0.6f), kHall)) / expected, 1, 1e-6);
  const auto estimate = [](const LightMap& map, std::uint32_t seed) {
    return summed_flux(map, [&](std::uint32_t i) { return random_point(seed, i); });
  };
  EXPECT_LT(std::abs(jittered_power_z(estimate, expected)), kSigmas);
  const auto one_cell_short = [](const LightMap& map, std::uint32_t seed) {
    return summed_flux(map, [&](std::uint32_t i) { return random_point(seed, i); }) * 59 / 60;
  };
  EXPECT_GT(std::abs(jittered_power_z(one_cell_short, expected)), 10);
}

// Share of uniformly drawn points of the square that land within a cone round some axis.
double share_in_cone(const std::function<Vec3(Vec2)>& direction, Vec3 axis, float cosine, std::uint32_t points) {
  std::uint32_t inside = 0;
  for (std::uint32_t i = 0; i < points; ++i) inside += dot(direction(random_point(7, i)), axis) > cosine;
  return static_cast<double>(inside) / points;
}

TEST(OctahedralMap, gives_equal_solid_angles_to_equal_areas) {
  constexpr std::uint32_t kPoints = 200000;
  const auto plain = [](Vec2 p) {  // the usual octahedral map, which needs a weight: the control
    const float a = 2 * p.x - 1, b = 2 * p.y - 1, z = 1 - std::abs(a) - std::abs(b);
    return normalize(z >= 0 ? Vec3(a, b, z)
                            : Vec3(std::copysign(1 - std::abs(b), a), std::copysign(1 - std::abs(a), b), z));
  };
  int plain_caught = 0;
  for (const Vec3 axis : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0), normalize(Vec3(1, 1, 1)),
                          normalize(Vec3(-1, 1, -1))}) {
    const float cosine = 0.9f;
    const double expected = 0.05, sigma = std::sqrt(expected * (1 - expected) / kPoints);
    EXPECT_LT(std::abs(share_in_cone(f32::octahedral_direction, axis, cosine, kPoints) - expected), kSigmas * sigma);
    plain_caught += std::abs(share_in_cone(plain, axis, cosine, kPoints) - expected) > 10 * sigma;
  }
  EXPECT_EQ(plain_caught, 6);
}

TEST(ConeMap, fills_the_cone_evenly_and_nothing_else) {
  constexpr std::uint32_t kPoints = 200000;
  const float cos_outer = 0.8f;
  const auto direction = [&](Vec2 p) { return f32::cone_direction(p, cos_outer); };
  double least = 1;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Vec3 d = direction(random_point(3, i));
    EXPECT_NEAR(length(d), 1, 1e-6);
    least = std::min(least, static_cast<double>(d.z));
  }
  EXPECT_GE(least, 0.8 - 1e-6);
  EXPECT_LT(least, 0.801);
  const double expected = 0.5, sigma = std::sqrt(0.25 / kPoints);  // half of the solid angle above cos = 0.9
  EXPECT_LT(std::abs(share_in_cone(direction, Vec3(0, 0, 1), 0.9f, kPoints) - expected), kSigmas * sigma);
  const auto linear = [&](Vec2 p) {  // radius without Lambert's rule, the control
    Vec3 d = f32::cone_direction(p, cos_outer);
    const float t = std::sqrt((1 - d.z) / (1 - cos_outer));
    d.z = 1 - (1 - cos_outer) * t;
    return d;
  };
  EXPECT_GT(std::abs(share_in_cone(linear, Vec3(0, 0, 1), 0.9f, kPoints) - expected), 10 * sigma);
}

TEST(SunMap, covers_the_bounds_and_starts_outside_them) {
  PunctualLight sun = spot(1, 0);
  sun.kind = PunctualLight::Kind::directional;
  const LightMap map(sun, 4096, kHall);
  Bounds across;
  for (std::uint32_t i = 0; i < map.size(); ++i) {
    const TexelRay ray = map.ray(i, centre(i));
    EXPECT_EQ(length(ray.direction - sun.direction), 0);
    EXPECT_LT(dot(ray.origin - kHall.centre(), sun.direction), 0);
    const Basis frame = frame_around(sun.direction);
    across.grow(Vec3(dot(ray.origin, frame.right), dot(ray.origin, frame.up), 0));
  }
  const SunRectangle rectangle = sun_rectangle(sun.direction, kHall);
  EXPECT_GT((across.high.x - across.low.x) / rectangle.width, 0.97f);
  EXPECT_GT((across.high.y - across.low.y) / rectangle.height, 0.97f);
  EXPECT_LE(across.high.x - across.low.x, rectangle.width);
}

TEST(TexelShares, sum_to_the_total_and_follow_the_power) {
  for (const std::uint32_t n : kCounts) {
    const auto shares = share_texels({3.0f, 0.0f, 1.0f, NAN, 2.9f}, n);
    EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), 0u), n);
    EXPECT_EQ(shares[1] + shares[3], 0u);
    EXPECT_LE(std::abs(static_cast<double>(shares[0]) - n * 3.0 / 6.9), 1.0);
  }
  EXPECT_EQ(share_texels({0.0f, 0.0f}, 5)[0], 3u);
  EXPECT_TRUE(share_texels({}, 5).empty());
}

TEST(CellPartition, has_exactly_as_many_cells_as_asked_each_once) {
  for (const std::uint32_t n : kCounts) {
    for (const float aspect : {1.0f, 3.7f, 0.2f}) {
      const CellPartition cells(n, aspect);
      ASSERT_EQ(cells.size(), n);
      std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
      for (std::uint32_t i = 0; i < n; ++i) seen.insert({cells.cell(i).row, cells.cell(i).column});
      EXPECT_EQ(seen.size(), n);
    }
  }
  EXPECT_EQ(CellPartition(0, 1.0f).size(), 0u);
}

// Points drawn one per cell are spread evenly iff each cell has area 1/n: the mean of x*y over the unit square is 1/4.
TEST(CellPartition, cells_have_equal_areas_whatever_their_number) {
  for (const std::uint32_t n : {2u, 3u, 7u, 29u, 1000u}) {
    const CellPartition cells(n, 1.0f);
    double area = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const Vec2 low = cells.point(i, {0, 0}), high = cells.point(i, {1, 1});
      const double cell_area = static_cast<double>(high.x - low.x) * static_cast<double>(high.y - low.y);
      EXPECT_NEAR(cell_area * n, 1, 1e-4);
      area += cell_area;
    }
    EXPECT_NEAR(area, 1, 1e-5);
  }
}

double largest_run_diameter(const CellPartition& cells, const std::function<std::uint32_t(std::uint32_t)>& order) {
  double largest = 0;
  for (std::uint32_t first = 0; first + 64 <= cells.size(); first += 13) {
    Bounds run;
    for (std::uint32_t i = first; i < first + 64; ++i) {
      const Vec2 p = cells.point(order(i), {0.5f, 0.5f});
      run.grow(Vec3(p.x, p.y, 0));
    }
    largest = std::max(largest, static_cast<double>(run.diagonal()));
  }
  return largest * std::sqrt(static_cast<double>(cells.size()));  // in cells
}

TEST(CellPartition, any_64_successive_cells_lie_together) {
  for (const std::uint32_t n : {65536u, 40000u, 10007u}) {
    const CellPartition cells(n, 1.0f);
    EXPECT_LT(largest_run_diameter(cells, [](std::uint32_t i) { return i; }), 32) << n;
    // The control: the same cells in a scattered order.
    EXPECT_GT(largest_run_diameter(cells, [n](std::uint32_t i) { return std::uint32_t(i * 7919ull % n); }), 100) << n;
  }
}

TEST(CellPartition, every_64th_cell_is_one_of_each_8_by_8_block) {
  const CellPartition cells(65536, 1.0f);
  for (std::uint32_t subset = 0; subset < 64; ++subset) {
    std::set<std::uint32_t> blocks;
    for (std::uint32_t i = subset; i < cells.size(); i += 64) {
      blocks.insert(cells.cell(i).row / 8 * 32 + cells.cell(i).column / 8);
    }
    EXPECT_EQ(blocks.size(), 1024u);
  }
}

}  // namespace
}  // namespace luciole
