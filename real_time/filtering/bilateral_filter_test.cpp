// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/bilateral_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "base/parallel.h"
#include "equations/cpp/instruction_set.h"
#include "real_time/filtering/reference_filter.h"
#include "real_time/filtering/synthetic_room.h"

namespace luciole {
namespace {

constexpr float kUlp = std::numeric_limits<float>::epsilon();
constexpr float kSummed = 289 * kUlp;  // a sum over 17 x 17 taps rounds once per tap

std::vector<Isa> instruction_sets() {
  std::vector<Isa> sets = {Isa::baseline};
  if (supports(InstructionSet::avx2)) sets.push_back(Isa::avx2);
  if (supports(InstructionSet::avx512)) sets.push_back(Isa::avx512);
  return sets;
}

Radiance filtered(const GeometryBuffer& geometry, const Radiance& noisy, Isa isa, FilterRadius radius = {8, 8}) {
  return BilateralFilterPass().run({geometry, noisy, radius, isa});
}

std::vector<const Plane*> planes_of(const Radiance& light) {
  return {&light.diffuse[0],  &light.diffuse[1],  &light.diffuse[2],
          &light.specular[0], &light.specular[1], &light.specular[2]};
}

bool same_bits(const Radiance& a, const Radiance& b) {
  for (std::size_t c = 0; c < 6; ++c) {
    const Plane &x = *planes_of(a)[c], &y = *planes_of(b)[c];
    if (x.size() != y.size() || std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) != 0) return false;
  }
  return true;
}

void fill(Plane3& planes, std::size_t at, Vec3 v) { planes[0][at] = v.x, planes[1][at] = v.y, planes[2][at] = v.z; }

void set_surface(GeometryBuffer& g, std::size_t at, float depth, Vec3 normal) {
  const auto x = static_cast<std::uint32_t>(at % g.width), y = static_cast<std::uint32_t>(at / g.width);
  g.depth[at] = depth;
  fill(g.position, at, pixel_ray(g, x, y) * depth);
  fill(g.normal, at, normal);
  fill(g.geometric_normal, at, normal);
}

// A plane through (0, 0, -4) that fills the view.
GeometryBuffer tilted_plane(std::uint32_t width, std::uint32_t height, Vec3 normal) {
  SyntheticRoom room = make_synthetic_room(width, height);
  GeometryBuffer& g = room.geometry;
  for (std::size_t at = 0; at < g.pixel_count(); ++at) {
    const auto x = static_cast<std::uint32_t>(at % width), y = static_cast<std::uint32_t>(at / width);
    set_surface(g, at, -4.0f * normal.z / dot(normal, pixel_ray(g, x, y)), normal);
    fill(g.f0, at, {0.04f, 0.04f, 0.04f});
    g.ggx_alpha[at] = 0.3f, g.material[at] = 0;
  }
  return std::move(room.geometry);
}

template <class Value>  // Value(x, y) -> float, the same for all six channels
Radiance light_of(const GeometryBuffer& g, const Value& value) {
  Radiance light;
  resize_light(light, g.pixel_count());
  for (std::size_t at = 0; at < g.pixel_count(); ++at) {
    const float v = value(static_cast<int>(at % g.width), static_cast<int>(at / g.width));
    fill(light.diffuse, at, {v, v, v});
    fill(light.specular, at, {v, v, v});
  }
  return light;
}

// Largest difference from 1 of a channel where the whole footprint is inside the picture.
double largest_deviation(const GeometryBuffer& g, const Plane& plane, float expected) {
  double largest = 0;
  for (std::uint32_t y = 8; y + 8 < g.height; ++y) {
    for (std::uint32_t x = 8; x + 8 < g.width; ++x) {
      largest = std::max(largest, std::abs(double(plane[std::size_t(y) * g.width + x]) / expected - 1.0));
    }
  }
  return largest;
}

Radiance interleaved_pattern(const GeometryBuffer& g, int n, float& mean) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.0f, 2.0f);
  std::vector<float> values(static_cast<std::size_t>(n * n));
  double sum = 0;
  for (float& v : values) v = uniform(random), sum += double(v);
  mean = static_cast<float>(sum / double(n * n));
  return light_of(g, [&](int x, int y) { return values[static_cast<std::size_t>(y % n * n + x % n)]; });
}

const Vec3 kTilted = normalize(Vec3{0.3f, 0.6f, 0.5f});

TEST(BilateralFilter, leaves_no_period_of_interleaving_on_a_plane) {
  const GeometryBuffer g = tilted_plane(75, 41, kTilted);
  for (const int n : {1, 2, 4, 8}) {
    float mean = 0;
    const Radiance noisy = interleaved_pattern(g, n, mean);
    for (const Isa isa : instruction_sets()) {
      const Radiance clean = filtered(g, noisy, isa, filter_radius(static_cast<std::uint32_t>(n)));
      // Weights differ from 1 by the rounding of a tap's plane distance, 10 operations on terms of 1/footprint,
      // squared; sums of 289 taps round once each.
      for (const Plane* plane : planes_of(clean)) EXPECT_LT(largest_deviation(g, *plane, mean), kSummed);
    }
  }
}

TEST(BilateralFilter, full_weight_of_the_outermost_taps_is_caught) {
  const GeometryBuffer g = tilted_plane(40, 30, kTilted);
  float mean = 0;
  const Radiance noisy = interleaved_pattern(g, 8, mean);
  ReferenceFilter wrong;
  wrong.end_weight = 1;
  EXPECT_GT(largest_deviation(g, filter_by_definition(wrong, g, noisy).light.diffuse[0], mean), 100 * kSummed);
  EXPECT_LT(largest_deviation(g, filter_by_definition({}, g, noisy).light.diffuse[0], mean), kSummed);
}

TEST(BilateralFilter, agrees_with_its_definition) {
  for (const auto& [width, height] :
       {std::pair{97u, 72u}, std::pair{1u, 1u}, std::pair{17u, 3u}, std::pair{1919u, 7u}}) {
    const SyntheticRoom room = make_synthetic_room(width, height);
    const Radiance noisy = interleaved_noise(room, 8, 3);
    for (const FilterRadius radius : {FilterRadius{8, 8}, FilterRadius{0, 3}, FilterRadius{5, 0}, FilterRadius{0, 0}}) {
      ReferenceFilter definition;
      definition.radius = radius;
      const ReferenceLight expected = filter_by_definition(definition, room.geometry, noisy);
      for (const Isa isa : instruction_sets()) {
        const Radiance clean = filtered(room.geometry, noisy, isa, radius);
        for (std::size_t c = 0; c < 6; ++c) {
          const Plane &found = *planes_of(clean)[c], &light = *planes_of(expected.light)[c];
          for (std::size_t at = 0; at < found.size(); ++at) {
            ASSERT_NEAR(found[at], light[at], (*planes_of(expected.rounding)[c])[at] + kUlp * std::abs(light[at]))
                << "pixel " << at << " of " << width << "x" << height << ", channel " << c << ", " << to_string(isa);
          }
        }
      }
    }
  }
}

// The tolerance above is narrow enough to tell a pixel's tangent plane from its neighbour's.
TEST(BilateralFilter, another_definition_is_caught) {
  const SyntheticRoom room = make_synthetic_room(97, 72);
  const Radiance noisy = interleaved_noise(room, 8, 3);
  const ReferenceLight expected = filter_by_definition({}, room.geometry, noisy);
  ReferenceFilter wrong;
  wrong.radius = {8, 7};
  const Radiance other = filter_by_definition(wrong, room.geometry, noisy).light;
  std::size_t caught = 0, surfaces = 0;
  for (std::size_t at = 0; at < room.geometry.pixel_count(); ++at) {
    if (!(room.geometry.depth[at] < kNoSurface)) continue;
    ++surfaces;
    const double difference = std::abs(double(other.diffuse[0][at]) - double(expected.light.diffuse[0][at]));
    caught += difference > double(expected.rounding.diffuse[0][at]) + double(kUlp * expected.light.diffuse[0][at]);
  }
  EXPECT_GT(double(caught), 0.5 * double(surfaces));
}

// Left half: light 1; right half: light 0, on another surface. Nothing may cross.
void expect_sharp(const GeometryBuffer& g, bool diffuse_too) {
  const auto middle = static_cast<int>(g.width / 2);
  const Radiance noisy = light_of(g, [&](int x, int) { return x < middle ? 1.0f : 0.0f; });
  const Radiance leaking = filter_by_definition({{8, 8}, 0.5, false, true}, g, noisy).light;
  const std::size_t beside = std::size_t(g.height / 2) * g.width + std::size_t(middle);
  EXPECT_GT(leaking.diffuse[0][beside], 0.4f) << "a blur without guides leaks: the test can fail";
  for (const Isa isa : instruction_sets()) {
    const Radiance clean = filtered(g, noisy, isa);
    for (std::size_t at = 0; at < g.pixel_count(); ++at) {
      const float expected = static_cast<int>(at % g.width) < middle ? 1.0f : 0.0f;
      ASSERT_NEAR(clean.specular[0][at], expected, kSummed);
      if (diffuse_too) {
        ASSERT_NEAR(clean.diffuse[0][at], expected, kSummed);
      }
    }
  }
}

TEST(BilateralFilter, does_not_leak_between_walls_that_meet) {
  GeometryBuffer g = tilted_plane(40, 24, {0, 0, 1});
  const Vec3 left = normalize(Vec3{0.6f, 0, 1}), right = normalize(Vec3{-0.6f, 0, 1});
  for (std::size_t at = 0; at < g.pixel_count(); ++at) {
    const auto x = static_cast<std::uint32_t>(at % g.width), y = static_cast<std::uint32_t>(at / g.width);
    const Vec3 normal = x < g.width / 2 ? left : right;  // both contain the line x = 0, z = -4
    set_surface(g, at, -4.0f * normal.z / dot(normal, pixel_ray(g, x, y)), normal);
  }
  expect_sharp(g, true);
}

TEST(BilateralFilter, does_not_leak_over_a_step_in_depth) {
  GeometryBuffer g = tilted_plane(40, 24, {0, 0, 1});
  const float footprint = 2.0f * std::tan(0.5f * g.camera.vertical_fov) / static_cast<float>(g.height);
  for (std::size_t at = 0; at < g.pixel_count(); ++at) {
    const bool left = at % g.width < g.width / 2;  // a step of five footprints
    set_surface(g, at, left ? 4.0f : 4.0f * (1.0f + 5.0f * footprint), {0, 0, 1});
  }
  expect_sharp(g, true);
}

TEST(BilateralFilter, keeps_reflections_of_other_roughness_apart) {
  GeometryBuffer g = tilted_plane(40, 24, kTilted);
  for (std::size_t at = 0; at < g.pixel_count(); ++at) g.ggx_alpha[at] = at % g.width < g.width / 2 ? 0.2f : 0.4f;
  expect_sharp(g, false);
}

TEST(BilateralFilter, metals_do_not_darken_the_diffuse_light_beside_them) {
  GeometryBuffer g = tilted_plane(40, 24, kTilted);
  const auto is_metal = [&](std::size_t at) { return at % g.width >= g.width / 2; };
  Radiance noisy = light_of(g, [](int, int) { return 1.0f; });
  for (std::size_t at = 0; at < g.pixel_count(); ++at) {
    if (!is_metal(at)) continue;
    fill(g.f0, at, {1.0f, 0.77f, 0.34f});
    fill(noisy.diffuse, at, {0, 0, 0});
  }
  EXPECT_LT(
      filter_by_definition({{8, 8}, 0.5, false, true}, g, light_of(g, [](int x, int) { return x < 20 ? 1.0f : 0.0f; }))
          .light.diffuse[0][g.width * 12 + 19],
      0.8f);
  for (const Isa isa : instruction_sets()) {
    const Radiance clean = filtered(g, noisy, isa);
    for (std::size_t at = 0; at < g.pixel_count(); ++at) {
      if (!is_metal(at)) {
        ASSERT_NEAR(clean.diffuse[0][at], 1.0f, kUlp);
      }
    }
  }
}

TEST(BilateralFilter, neither_brightens_nor_darkens_constant_light) {
  SyntheticRoom room = make_synthetic_room(131, 90);
  GeometryBuffer& g = room.geometry;
  const Radiance third = light_of(g, [](int, int) { return 1.0f / 3.0f; });
  for (std::size_t at = 0; at < g.pixel_count(); ++at) fill(g.f0, at, {0.5f, 0.5f, 0.5f});  // divides exactly
  for (const Isa isa : instruction_sets()) EXPECT_TRUE(same_bits(filtered(g, third, isa), third));
  for (std::size_t at = 0; at < g.pixel_count(); ++at) fill(g.f0, at, {0.07f, 0.05f, 0.04f});  // rounds twice
  for (const Isa isa : instruction_sets()) {
    const Radiance clean = filtered(g, third, isa);
    for (const Plane* plane : planes_of(clean)) {
      for (const float value : *plane) ASSERT_NEAR(value, 1.0f / 3.0f, kUlp / 3.0f);
    }
  }
  const Radiance dark = filter_by_definition({{8, 8}, 0.5, true, false}, g, third).light;
  EXPECT_LT(dark.diffuse[0][0], 0.3f) << "dividing by the number of taps is caught";
}

TEST(BilateralFilter, sky_neither_gives_nor_takes) {
  GeometryBuffer g = tilted_plane(40, 24, kTilted);
  const auto is_sky = [&](std::size_t at) { return at % g.width < 20 && at / g.width < 12; };
  Radiance noisy = light_of(g, [](int x, int y) { return x < 20 && y < 12 ? 50.0f : 0.25f; });
  const Radiance leaking = filter_by_definition({{8, 8}, 0.5, false, true}, g, noisy).light;
  EXPECT_GT(leaking.diffuse[0][g.width * 12 + 10], 1.0f) << "the test can fail";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t at = 0; at < g.pixel_count(); ++at) {
    if (is_sky(at)) set_surface(g, at, kNoSurface, {nan, nan, nan});
  }
  for (const Isa isa : instruction_sets()) {
    const Radiance clean = filtered(g, noisy, isa);
    for (std::size_t at = 0; at < g.pixel_count(); ++at) {
      ASSERT_NEAR(clean.diffuse[0][at], is_sky(at) ? 50.0f : 0.25f, 0.25f * kUlp);
      ASSERT_NEAR(clean.specular[2][at], is_sky(at) ? 50.0f : 0.25f, 0.25f * kUlp);
    }
  }
}

TEST(BilateralFilter, light_that_is_not_finite_is_replaced_by_its_neighbours) {
  const GeometryBuffer g = tilted_plane(40, 24, kTilted);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const Radiance noisy = light_of(g, [&](int x, int y) { return x == 20 && y == 12 ? bad : 0.5f; });
    for (const Isa isa : instruction_sets()) {
      const Radiance clean = filtered(g, noisy, isa);
      for (const Plane* plane : planes_of(clean)) {
        for (const float value : *plane) ASSERT_NEAR(value, 0.5f, 0.5f * kUlp);
      }
    }
  }
}

TEST(BilateralFilter, a_pixel_like_no_other_keeps_its_own_light) {
  GeometryBuffer g = tilted_plane(33, 33, {0, 0, 1});
  const std::size_t lonely = 16 * 33 + 16;
  set_surface(g, lonely, 2.0f, {0, 0, 1});
  const Radiance noisy = light_of(g, [](int x, int y) { return x == 16 && y == 16 ? 9.0f : 0.5f; });
  for (const Isa isa : instruction_sets()) {
    const Radiance clean = filtered(g, noisy, isa);
    EXPECT_NEAR(clean.diffuse[0][lonely], 9.0f, 9.0f * kUlp);
    EXPECT_NEAR(clean.diffuse[0][lonely + 1], 0.5f, 0.5f * kUlp);
  }
  EXPECT_LT(filter_by_definition({{8, 8}, 0.5, false, true}, g, noisy).light.diffuse[0][lonely], 1.0f);
}

TEST(BilateralFilter, knows_no_unit_of_length) {
  const SyntheticRoom room = make_synthetic_room(97, 72);
  const Radiance noisy = interleaved_noise(room, 8, 3);
  GeometryBuffer larger = make_synthetic_room(97, 72).geometry, deeper = make_synthetic_room(97, 72).geometry;
  for (std::size_t at = 0; at < larger.pixel_count(); ++at) larger.depth[at] *= 1024.0f;
  for (std::size_t at = 0; at < larger.pixel_count(); ++at) deeper.depth[at] += 3.0f;
  for (const Isa isa : instruction_sets()) {
    EXPECT_TRUE(same_bits(filtered(larger, noisy, isa), filtered(room.geometry, noisy, isa)));
    EXPECT_FALSE(same_bits(filtered(deeper, noisy, isa), filtered(room.geometry, noisy, isa)));
  }
}

TEST(BilateralFilter, gives_the_same_bits_for_any_number_of_threads) {
  const SyntheticRoom room = make_synthetic_room(200, 150);
  const Radiance noisy = interleaved_noise(room, 8, 3), other = interleaved_noise(room, 8, 4);
  for (const Isa isa : instruction_sets()) {
    Radiance alone, together;
    with_threads(1, [&] { alone = filtered(room.geometry, noisy, isa); });
    for (const int threads : {2, 5}) {
      with_threads(threads, [&] { together = filtered(room.geometry, noisy, isa); });
      EXPECT_TRUE(same_bits(alone, together));
    }
    EXPECT_FALSE(same_bits(alone, filtered(room.geometry, other, isa)));
  }
}

TEST(BilateralFilter, comes_closer_to_the_truth) {
  const SyntheticRoom room = make_synthetic_room(320, 180);
  const Radiance noisy = interleaved_noise(room, 8, 3);
  const double before = relative_error(room, noisy);
  const double blurred =
      relative_error(room, filter_by_definition({{8, 8}, 0.5, false, true}, room.geometry, noisy).light);
  for (const Isa isa : instruction_sets()) {
    const double after = relative_error(room, filtered(room.geometry, noisy, isa));
    EXPECT_LT(after, 0.1 * before);
    EXPECT_LT(after, blurred);
  }
}

TEST(BilateralFilter, empty_light_stays_empty) {
  const SyntheticRoom room = make_synthetic_room(20, 10);
  EXPECT_TRUE(filtered(room.geometry, Radiance{}, Isa::baseline).diffuse[0].empty());
}

}  // namespace
}  // namespace luciole
