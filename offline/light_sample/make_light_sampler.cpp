// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/make_light_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "offline/light_sample/cone_tree.h"
#include "offline/light_sample/culling_sampler.h"
#include "offline/light_sample/exhaustive_sampler.h"
#include "offline/light_sample/table_sampler.h"

namespace luciole {
namespace {

// Lights accepted per surface point and pass. More are better chosen among and cost more: the least error in equal time
// is flat between 12 and 24 (docs/decisions/0013-choice-of-lights-offline.md).
constexpr double kAccepted = 16;
constexpr std::uint32_t kMostProbed = 4096;  // lights that the floor is fitted to

// Unoccluded radiances I s / l^2, counted by size.
struct Histogram {
  static constexpr int kPerOctave = 32, kLowest = -126 * kPerOctave, kBuckets = 252 * kPerOctave;
  std::array<std::uint64_t, kBuckets> count{};
  std::array<double, kBuckets> sum{};

  void add(float radiance) {
    const int size = static_cast<int>(std::floor(kPerOctave * std::log2(radiance)));
    const auto bucket = static_cast<std::size_t>(std::clamp(size - kLowest, 0, kBuckets - 1));
    ++count[bucket];
    sum[bucket] += radiance;
  }
  static double lowest_of(int bucket) { return std::exp2(double(bucket + kLowest) / kPerOctave); }
  // How many are accepted with a radiance floor: all above it, those below by their share of it.
  double accepted(double floor) const {
    double sum_accepted = 0;
    for (int bucket = 0; bucket < kBuckets; ++bucket) {
      const auto i = static_cast<std::size_t>(bucket);
      sum_accepted += lowest_of(bucket) >= floor ? static_cast<double>(count[i]) : sum[i] / floor;
    }
    return sum_accepted;
  }
  void add(const Histogram& other) {
    for (std::size_t i = 0; i < kBuckets; ++i) count[i] += other.count[i], sum[i] += other.sum[i];
  }
};

float unoccluded_radiance(const LightRecord& light, const Receiver& receiver) {
  const Vec3 apart = light.centre() - Vec3(receiver.position[0], receiver.position[1], receiver.position[2]);
  const Vec3 normal(receiver.geometric_normal[0], receiver.geometric_normal[1], receiver.geometric_normal[2]);
  if (dot(apart, normal) + light.radius <= 0) return 0;
  const float distance_sq = std::max({dot(apart, apart), light.radius * light.radius, 1e-20f});
  return light.intensity * directional_factor(light, -dot(light.axis(), apart) / std::sqrt(distance_sq)) / distance_sq;
}

Histogram histogram_of(const LightSet& lights, const std::vector<Receiver>& receivers, std::uint32_t probed) {
  constexpr std::size_t kGroup = 64;  // receivers per unit of work; their sums are added in order
  std::vector<Histogram> parts((receivers.size() + kGroup - 1) / kGroup);
  parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) {
      for (std::size_t r = part * kGroup; r < std::min(receivers.size(), (part + 1) * kGroup); ++r) {
        for (std::uint32_t k = 0; k < probed; ++k) {
          const auto light = static_cast<std::uint32_t>(std::uint64_t(k) * lights.size() / probed);
          const float radiance = unoccluded_radiance(lights.records()[light], receivers[r]);
          if (radiance > 0) parts[part].add(radiance);
        }
      }
    }
  });
  Histogram all;
  for (const Histogram& part : parts) all.add(part);
  return all;
}

float mean_total_weight(const LightSampler& sampler, const std::vector<Receiver>& receivers) {
  double sum = 0;
  ChoiceMemory memory;
  Candidates candidates;
  for (const Receiver& receiver : receivers) {
    sampler.share_candidates(&receiver, 1, candidates);
    sampler.choose(receiver, candidates, 0.5, memory);
    sum += memory.total_weight;
  }
  return static_cast<float>(std::max(sum / static_cast<double>(std::max<std::size_t>(receivers.size(), 1)), 1e-30));
}

template <class Sampler>
std::unique_ptr<LightSampler> culling(const SamplerInputs& in, CullingParameters parameters) {
  if (in.settings.range_samples == RangeNumbers::stratified && in.settings.lights == LightChoice::culling) {
    Sampler probe(in.lights, in.settings, parameters);
    probe.begin_pass(~std::uint64_t(0));  // ranges that are not in the picture
    parameters.stand_in_weight = mean_total_weight(probe, in.receivers);
  }
  return std::make_unique<Sampler>(in.lights, in.settings, parameters);
}

}  // namespace

float fitted_radiance_floor(const LightSet& lights, const std::vector<Receiver>& receivers, double wanted) {
  constexpr float kAlmostNone = 1e-20f;
  const std::uint32_t probed = std::min(lights.size(), kMostProbed);
  if (probed == 0 || receivers.empty()) return kAlmostNone;
  const Histogram all = histogram_of(lights, receivers, probed);
  wanted *= double(probed) * static_cast<double>(receivers.size()) / lights.size();
  double above = 0, below = 0;  // how many lie above the floor, and the radiance of those that lie below
  for (const double sum : all.sum) below += sum;
  for (int bucket = Histogram::kBuckets - 1; bucket >= 0; --bucket) {
    const auto i = static_cast<std::size_t>(bucket);
    const double floor = Histogram::lowest_of(bucket);
    above += static_cast<double>(all.count[i]), below -= all.sum[i];
    if (above + below / floor >= wanted) return static_cast<float>(floor);
  }
  return kAlmostNone;  // fewer lights than are wanted: all of them, always
}

double mean_weighed(const RangeTree& tree, const std::vector<Receiver>& receivers, Isa isa) {
  std::uint64_t count = 0;
  for (const Receiver& receiver : receivers) {
    const float* p = receiver.position;
    const WalkBounds point{{p[0], p[1], p[2]}, {p[0], p[1], p[2]}, 0, tree.block_count()};
    tree.for_each_overlapping(point, isa, [&](std::uint32_t) { ++count; });
  }
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(receivers.size(), 1));
}

float affordable_radiance_floor(const SamplerInputs& in, float floor) {
  constexpr std::uint64_t kProbePass = ~std::uint64_t(1);  // ranges that are not in the picture
  constexpr int kMostSteps = 8;
  constexpr double kCloseEnough = 1.05;
  RangeTree tree(in.lights, in.scene_diagonal);
  for (int step = 0; step < kMostSteps; ++step) {
    tree.draw(in.settings.seed, kProbePass, in.settings.range_samples, floor);
    const double excess = mean_weighed(tree, in.receivers, in.settings.isa) / kMostWeighed;
    if (excess <= kCloseEnough) break;
    floor *= static_cast<float>(excess);  // fewer by less than that factor: ranges only shrink with its root
  }
  return floor;
}

float fitted_clamp(const LightSet& lights, const std::vector<Receiver>& receivers, float radiance_floor) {
  const std::uint32_t probed = std::min(lights.size(), kMostProbed);
  if (probed == 0 || receivers.empty()) return 0.5f;
  const Histogram all = histogram_of(lights, receivers, probed);
  double left = all.accepted(radiance_floor);
  for (int bucket = Histogram::kBuckets - 1; bucket >= 0; --bucket) {
    const auto count = static_cast<double>(all.count[static_cast<std::size_t>(bucket)]);
    if (count >= left && count > 0) {
      // Within a bucket as if its lights were spread evenly.
      const double threshold = Histogram::lowest_of(bucket) * std::exp2((1 - left / count) / Histogram::kPerOctave);
      return static_cast<float>(std::min(threshold / radiance_floor, 0.999999));
    }
    left -= count;
  }
  return 1e-9f;  // every light, from everywhere
}

std::unique_ptr<LightSampler> make_light_sampler(const SamplerInputs& in) {
  switch (in.settings.lights) {
    case LightChoice::uniform:
      return std::make_unique<TableSampler>(in.lights, TableSampler::By::count);
    case LightChoice::power:
      return std::make_unique<TableSampler>(in.lights, TableSampler::By::flux);
    case LightChoice::tree:
      return std::make_unique<ConeTreeSampler>(in.lights, in.scene);
    case LightChoice::exhaustive:
      return std::make_unique<ExhaustiveSampler>(in.lights, in.settings.isa);
    case LightChoice::culling:
    case LightChoice::clamped:
      break;
  }
  CullingParameters parameters;
  parameters.exposure = in.settings.exposure, parameters.scene_diagonal = in.scene_diagonal;
  // [TH16] Eq. 7: alpha_i = 2 pi eps / (E I_i); floor = alpha_i I_i.
  parameters.radiance_floor =
      in.settings.error_bound > 0
          ? 2 * std::numbers::pi_v<float> * in.settings.error_bound / in.settings.exposure
          : affordable_radiance_floor(in, fitted_radiance_floor(in.lights, in.receivers, kAccepted));
  if (in.settings.lights == LightChoice::clamped) {
    parameters.clamp_xi = fitted_clamp(in.lights, in.receivers, parameters.radiance_floor);
    return culling<ClampedSampler>(in, parameters);
  }
  if (in.settings.resampling == Resampling::list) return culling<ListSampler>(in, parameters);
  return culling<CullingSampler>(in, parameters);
}

}  // namespace luciole
