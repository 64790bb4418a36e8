// SPDX-License-Identifier: Apache-2.0
// Every way to choose lights, light by light: what shadow rays and the BSDF's rays find of one light must add up to
// what it sends, on average. A wrong combination can be off by 10 % per light and by nothing in the sum.
#include "offline/light_sample/light_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "offline/light_sample/cone_tree.h"
#include "offline/light_sample/culling_sampler.h"
#include "offline/light_sample/exhaustive_sampler.h"
#include "offline/light_sample/light_point.h"
#include "offline/light_sample/table_sampler.h"
#include "offline/path/bsdf.h"
#include "offline/path/path_batch.h"
#include "offline/path/sample_sequence.h"

namespace luciole {
namespace {

constexpr std::uint32_t kLights = 12;
constexpr float kFloor = 0.35f;  // radiance floor: two thirds of the lights are subject to roulette

// Twelve triangles that look at a surface point at the origin, from half a metre to six metres away, none before
// another; the first is large and near.
//   alike  instead all fill the same angle: each is as well found by the BSDF's rays as by shadow rays
Scene ring_of_lights(bool alike) {
  Scene scene;
  Material glow;
  glow.emission = {2, 2, 2};
  scene.materials.push_back(glow);
  Mesh mesh;
  for (std::uint32_t i = 0; i < kLights; ++i) {
    const float azimuth = 6.2831853f * static_cast<float>(i) / kLights, height = 0.25f + 0.055f * static_cast<float>(i);
    const float distance = 0.5f + 0.5f * static_cast<float>(i), level = std::sqrt(1 - height * height);
    const Vec3 outwards(level * std::cos(azimuth), level * std::sin(azimuth), height);
    const TangentFrame frame(-outwards);
    const float size = alike ? 0.13f * distance : i == 0 ? 0.25f : 0.1f + 0.05f * static_cast<float>(i % 4);
    for (int k = 0; k < 3; ++k) {
      const float turn = 2.0943951f * static_cast<float>(k);
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(outwards * distance + frame.x * (size * std::cos(turn)) +
                               frame.y * (size * std::sin(turn)));
    }
  }
  scene.meshes.push_back(mesh);
  return scene;
}

SurfacePoint glossy_point(float ggx_alpha) {
  SurfacePoint point{};
  point.geometric_normal = point.shading_normal = {0, 0, 1};
  point.diffuse_albedo = {0.4f, 0.4f, 0.4f}, point.f0 = {0.3f, 0.3f, 0.3f}, point.f90 = 1, point.ggx_alpha = ggx_alpha;
  return point;
}

struct Stage {
  explicit Stage(bool alike = false) : scene(ring_of_lights(alike)), point(glossy_point(alike ? 0.2f : 0.35f)) {}

  Scene scene;
  LightSet lights{scene};
  Vec3 to_eye = normalize(Vec3(0.5f, 0.2f, 0.6f));
  SurfacePoint point;
  Bsdf bsdf{point, to_eye};
  Receiver receiver = receiver_of(point, to_eye);

  Vec3 corner(std::uint32_t light, std::size_t k) const {
    return scene.meshes[0].positions[std::size_t(lights.records()[light].triangle) * 3 + k];
  }
  // The light that a direction meets; position and distance with it.
  std::uint32_t hit(Vec3 direction, Vec3& position) const {
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      const Vec3 a = corner(i, 0), ab = corner(i, 1) - a, ac = corner(i, 2) - a, p = cross(direction, ac);
      const float determinant = dot(ab, p);
      if (std::abs(determinant) < 1e-12f) continue;
      const float u = dot(-a, p) / determinant, v = dot(direction, cross(-a, ab)) / determinant;
      const float t = dot(ac, cross(-a, ab)) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || t <= 0) continue;
      position = direction * t;
      return i;
    }
    return kNoLight;
  }
  // What a light reflects towards the eye, by a fine midpoint rule over its area.
  double exact(std::uint32_t light) const {
    constexpr int kCells = 160;
    const Vec3 a = corner(light, 0), b = corner(light, 1), c = corner(light, 2);
    const double area = 0.5 * length(cross(b - a, c - a)) / (kCells * kCells);
    double sum = 0;
    for (int row = 0; row < kCells; ++row) {
      for (int place = 0; place < 2 * row + 1; ++place) {
        const float third = place % 2 == 0 ? 1.0f / 3 : 2.0f / 3;
        const float v = (static_cast<float>(place / 2) + third) / kCells;
        const float u = (static_cast<float>(row - place / 2) - (place % 2 == 0 ? 0.0f : 1.0f) + third) / kCells;
        const Vec3 y = a * (1 - u - v) + b * u + c * v;
        const float distance_sq = dot(y, y);
        const Vec3 direction = y * (1 / std::sqrt(distance_sq));
        sum += bsdf.evaluate(direction).x * -dot(lights.records()[light].axis(), direction) / distance_sq * area;
      }
    }
    return sum * 2;
  }
};

struct LightMean {
  double sum = 0, squares = 0;
  void add(double value) { sum += value, squares += value * value; }
  double z(double exact, double count) const {
    const double mean = sum / count, variance = std::max(squares / count - mean * mean, 1e-30);
    return (mean - exact) / std::sqrt(variance / count);
  }
};

struct Outcome {
  double largest_z = 0;    // over single lights
  double total_ratio = 1;  // of the sum to the exact sum
};

// Both techniques with the balance heuristic, as path_batch.cpp combines them, `samples` times.
Outcome estimate(const Stage& stage, LightSampler& sampler, std::uint32_t samples, bool with_bsdf = true) {
  std::vector<LightMean> means(kLights);
  Candidates candidates;
  for (std::uint32_t i = 0; i < samples; ++i) {
    SampleSequence numbers(21, i, 0);  // of many pixels: independent
    std::vector<double> found(kLights, 0.0);
    sampler.begin_pass(i);
    sampler.share_candidates(&stage.receiver, 1, candidates);
    ChoiceMemory memory;
    const f32::RandomWords words = numbers.pair_of_words();
    const ChosenLight chosen = sampler.choose(stage.receiver, candidates, words.first * 0x1p-32, memory);
    const Vec2 place = numbers.pair();
    if (chosen.light != kNoLight) {
      const LightPoint light = sample_light_point(stage.scene, stage.lights.records()[chosen.light], {0, 0, 0}, place);
      const float acceptance = light.pdf > 0 ? sampler.acceptance(chosen.light, light.place) : 0;
      if (acceptance > 0) {
        const float pmf = sampler.assumed_pmf(chosen.light, stage.receiver, memory, light.place, words.second);
        const double own = double(pmf) * light.pdf, other = with_bsdf ? stage.bsdf.pdf(light.direction) : 0.0;
        const double density = double(chosen.pmf) * acceptance * light.pdf;
        const double weight = std::isinf(own) || other == 0 ? 1 : own / (own + other);
        found[chosen.light] += stage.bsdf.evaluate(light.direction).x * light.radiance.x / density * weight;
      }
    }
    const Vec2 where = numbers.pair();
    const BsdfSample sample = stage.bsdf.sample(where, numbers.pair().x);
    Vec3 position;
    const std::uint32_t met = with_bsdf && sample.pdf > 0 ? stage.hit(sample.direction, position) : kNoLight;
    if (met != kNoLight) {
      const LightPoint light =
          light_point_hit(stage.scene, stage.lights.records()[met], {0, 0, 0}, sample.direction, position);
      if (light.pdf > 0) {
        const float pmf = sampler.assumed_pmf(met, stage.receiver, memory, light.place, numbers.bits());
        const double other = double(pmf) * light.pdf;
        found[met] += sample.weight.x * 2.0 * (std::isinf(other) ? 0 : sample.pdf / (sample.pdf + other));
      }
    }
    for (std::uint32_t light = 0; light < kLights; ++light) means[light].add(found[light]);
  }
  Outcome outcome;
  double sum = 0, exact = 0;
  for (std::uint32_t light = 0; light < kLights; ++light) {
    const double truth = stage.exact(light);
    outcome.largest_z = std::max(outcome.largest_z, std::abs(means[light].z(truth, samples)));
    sum += means[light].sum / samples, exact += truth;
  }
  outcome.total_ratio = sum / exact;
  return outcome;
}

constexpr std::uint32_t kSamples = 400000;

PathSettings settings_with(RangeNumbers numbers, std::uint32_t list_length = 3) {
  PathSettings settings;
  settings.isa = *choose_isa(Isa::automatic);
  settings.range_samples = numbers, settings.list_length = list_length;
  return settings;
}

CullingParameters parameters(float radiance_floor = kFloor) {
  CullingParameters p;
  p.radiance_floor = radiance_floor, p.scene_diagonal = 12, p.stand_in_weight = 1.5f;
  return p;
}

// Limit for the largest of 12 deviations: one in ten thousand right programs leaves it; seeds are fixed.
constexpr double kLimit = 4.5;

void expect_each_light_is_right(LightSampler& sampler, const Stage& stage) {
  for (const bool with_bsdf : {true, false}) {
    const Outcome outcome = estimate(stage, sampler, kSamples, with_bsdf);
    EXPECT_LT(outcome.largest_z, kLimit) << "with BSDF sampling " << with_bsdf << ", total " << outcome.total_ratio;
  }
}

TEST(LightSampler, uniform_choice_is_right_for_each_light) {
  const Stage stage;
  TableSampler sampler(stage.lights, TableSampler::By::count);
  expect_each_light_is_right(sampler, stage);
}

TEST(LightSampler, choice_by_flux_is_right_for_each_light) {
  const Stage stage;
  TableSampler sampler(stage.lights, TableSampler::By::flux);
  expect_each_light_is_right(sampler, stage);
}

TEST(LightSampler, tree_of_cones_is_right_for_each_light) {
  const Stage stage;
  ConeTreeSampler sampler(stage.lights, stage.scene);
  expect_each_light_is_right(sampler, stage);
}

TEST(LightSampler, exhaustive_choice_is_right_for_each_light) {
  const Stage stage;
  ExhaustiveSampler sampler(stage.lights, *choose_isa(Isa::automatic));
  expect_each_light_is_right(sampler, stage);
}

TEST(LightSampler, culling_is_right_for_each_light) {
  const Stage stage;
  CullingSampler sampler(stage.lights, settings_with(RangeNumbers::independent), parameters());
  expect_each_light_is_right(sampler, stage);
}

TEST(LightSampler, culling_with_printed_importance_is_right_for_each_light) {
  const Stage stage;
  PathSettings settings = settings_with(RangeNumbers::independent);
  settings.importance = Importance::printed;
  CullingSampler sampler(stage.lights, settings, parameters());
  expect_each_light_is_right(sampler, stage);
}

TEST(LightSampler, culling_with_stratified_ranges_is_right_for_each_light) {
  const Stage stage;
  CullingSampler sampler(stage.lights, settings_with(RangeNumbers::stratified), parameters());
  expect_each_light_is_right(sampler, stage);
}

TEST(LightSampler, culling_with_lists_is_right_for_each_light) {
  const Stage stage;
  for (const std::uint32_t k : {1u, 3u, 32u}) {
    ListSampler sampler(stage.lights, settings_with(RangeNumbers::independent, k), parameters());
    expect_each_light_is_right(sampler, stage);
  }
}

// The likely mistakes, each of which must be seen at the same size.

TEST(LightSampler, clamped_ranges_are_caught) {
  const Stage stage;
  ClampedSampler sampler(stage.lights, settings_with(RangeNumbers::independent), parameters());
  EXPECT_GT(estimate(stage, sampler, kSamples).largest_z, 10);
}

// Forgets p.   [TH16] Eq. 10 without its first factor
class WithoutProbability final : public CullingSampler {
 public:
  using CullingSampler::CullingSampler;
  float acceptance(std::uint32_t light, const LightPlace& place) const override {
    return CullingSampler::acceptance(light, place) > 0 ? 1 : 0;
  }
};

// Light that the BSDF finds counts in full where this pass's range does not reach: the shadow ray's 1/p counts it
// again.
class RealisedRangesOnly final : public CullingSampler {
 public:
  using CullingSampler::CullingSampler;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t random) const override {
    if (!(weight_in_range(light, receiver) > 0)) return 0;
    return CullingSampler::assumed_pmf(light, receiver, memory, place, random);
  }
};

// Light that the BSDF finds counts for nothing where this pass's range does not reach.
class IgnoringUnreached final : public CullingSampler {
 public:
  using CullingSampler::CullingSampler;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t random) const override {
    if (!(weight_in_range(light, receiver) > 0)) return std::numeric_limits<float>::infinity();
    return CullingSampler::assumed_pmf(light, receiver, memory, place, random);
  }
};

// A list that appends the light's weight but keeps its members and their number.
class AppendedToFullList final : public ListSampler {
 public:
  using ListSampler::ListSampler;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t /*random*/) const override {
    const float weight = weight_in_any_range(light, receiver);
    bool listed = false;
    for (std::uint32_t i = 0; i < memory.listed; ++i) listed |= memory.light[i] == light;
    const float total = memory.total_weight + (listed ? 0 : weight);
    const auto m = static_cast<float>(std::max(memory.overlapping, 1u));
    return probability_to_overlap(light, place) * std::min(static_cast<float>(settings_.list_length) / m, 1.0f) *
           weight / total;
  }
};

// Completion assumes that a light's range says nothing of the others': false for stratified ranges.
class StratifiedCompletion final : public CullingSampler {
 public:
  using CullingSampler::CullingSampler;
  void begin_pass(std::uint64_t pass) override {
    tree_.draw(settings_.seed, pass, RangeNumbers::stratified, parameters_.radiance_floor);
  }
};

template <class Sampler>
void expect_caught(float radiance_floor = 0.1f, std::uint32_t samples = kSamples) {
  const Stage stage(true);
  Sampler sampler(stage.lights, settings_with(RangeNumbers::independent, 1), parameters(radiance_floor));
  EXPECT_GT(estimate(stage, sampler, samples).largest_z, 7);
}

TEST(LightSampler, right_combinations_are_right_where_both_techniques_matter) {
  const Stage stage(true);
  CullingSampler all(stage.lights, settings_with(RangeNumbers::independent), parameters(0.1f));
  expect_each_light_is_right(all, stage);
  ListSampler list(stage.lights, settings_with(RangeNumbers::independent, 1), parameters(0.1f));
  expect_each_light_is_right(list, stage);
  CullingSampler few(stage.lights, settings_with(RangeNumbers::independent), parameters(0.3f));
  expect_each_light_is_right(few, stage);
  CullingSampler stratified(stage.lights, settings_with(RangeNumbers::stratified), parameters(0.1f));
  expect_each_light_is_right(stratified, stage);
}
TEST(LightSampler, a_forgotten_probability_is_caught) { expect_caught<WithoutProbability>(); }
TEST(LightSampler, counting_what_is_out_of_range_twice_is_caught) { expect_caught<RealisedRangesOnly>(); }
TEST(LightSampler, dropping_what_is_out_of_range_is_caught) { expect_caught<IgnoringUnreached>(); }
TEST(LightSampler, appending_to_a_full_list_is_caught) { expect_caught<AppendedToFullList>(); }
TEST(LightSampler, completion_with_stratified_ranges_is_caught) {
  expect_caught<StratifiedCompletion>(0.3f, 3 * kSamples);
}

// The choice's own bookkeeping: lights come as often as pmf says.
TEST(LightSampler, light_is_chosen_as_often_as_the_tree_of_cones_says) {
  const Stage stage;
  ConeTreeSampler sampler(stage.lights, stage.scene);
  Candidates candidates;
  ChoiceMemory memory;
  std::vector<int> count(kLights, 0);
  constexpr int kChoices = 200000;
  for (int i = 0; i < kChoices; ++i) {
    const ChosenLight chosen = sampler.choose(stage.receiver, candidates, (i + 0.5) / kChoices, memory);
    ASSERT_NE(chosen.light, kNoLight);
    EXPECT_FLOAT_EQ(chosen.pmf, sampler.assumed_pmf(chosen.light, stage.receiver, memory, {}, 0));
    ++count[chosen.light];
  }
  for (std::uint32_t light = 0; light < kLights; ++light) {
    const double expected = sampler.assumed_pmf(light, stage.receiver, memory, {}, 0);
    EXPECT_NEAR(count[light] / double(kChoices), expected, 1e-4);
  }
}

}  // namespace
}  // namespace luciole
