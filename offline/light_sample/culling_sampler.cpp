// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/culling_sampler.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numbers>

#include "equations/cpp/float.h"

namespace luciole {
namespace {

constexpr float kSharedRanges = 2;  // times the size of a group

}  // namespace
CullingSampler::CullingSampler(const LightSet& lights, const PathSettings& settings,
                               const CullingParameters& parameters)
    : lights_(lights),
      settings_(settings),
      parameters_(parameters),
      weight_(settings.importance == Importance::printed ? Weight::printed : Weight::reflected),
      tree_(lights, parameters.scene_diagonal) {}

void CullingSampler::begin_pass(std::uint64_t pass) {
  tree_.draw(settings_.seed, pass, settings_.range_samples, parameters_.radiance_floor);
}

void CullingSampler::add_overlapping(const WalkBounds& bounds, LightRows& rows) const {
  tree_.for_each_overlapping(bounds, settings_.isa, [&](std::uint32_t light) {
    rows.add(light, lights_.records()[light], lights_.tint(light), tree_.xi(light));
  });
}

// A group shares the lights whose ranges are larger than itself: most of what overlaps one of its points then overlaps
// the others. Of lights with shorter ranges a large group could meet thousands.
void CullingSampler::share_candidates(const Receiver* receivers, std::uint32_t count, Candidates& candidates) const {
  Bounds box;
  for (std::uint32_t i = 0; i < count; ++i) {
    box.grow({receivers[i].position[0], receivers[i].position[1], receivers[i].position[2]});
  }
  candidates.rows.clear();
  candidates.first_own_block = tree_.first_block_below(kSharedRanges * box.diagonal());
  if (candidates.first_own_block > 0) {
    add_overlapping(
        {{box.low.x, box.low.y, box.low.z}, {box.high.x, box.high.y, box.high.z}, 0, candidates.first_own_block},
        candidates.rows);
  }
  candidates.shared = candidates.rows.size();
}

void CullingSampler::find_own_candidates(const Receiver& receiver, Candidates& candidates) const {
  candidates.rows.shorten(candidates.shared);
  const float* p = receiver.position;
  if (candidates.first_own_block < tree_.block_count()) {
    add_overlapping({{p[0], p[1], p[2]}, {p[0], p[1], p[2]}, candidates.first_own_block, tree_.block_count()},
                    candidates.rows);
  }
}

ChosenLight CullingSampler::choose(const Receiver& receiver, Candidates& candidates, double u,
                                   ChoiceMemory& memory) const {
  find_own_candidates(receiver, candidates);
  WeightedChoice choice(u);
  choice.add(candidates.rows, receiver, weighing());
  memory.total_weight = choice.total();
  return choice.chosen();
}

float CullingSampler::weight_in_any_range(std::uint32_t light, const Receiver& receiver) const {
  return weight_of(lights_.records()[light], 0, receiver, weighing());
}

float CullingSampler::weight_in_range(std::uint32_t light, const Receiver& receiver) const {
  return weight_of(lights_.records()[light], tree_.xi(light), receiver, weighing());
}

float CullingSampler::probability_to_overlap(std::uint32_t light, const LightPlace& place) const {
  const float towards = lights_.records()[light].intensity * place.factor;
  return f32::acceptance_probability(towards, parameters_.radiance_floor, place.distance_sq);
}

float CullingSampler::acceptance(std::uint32_t light, const LightPlace& place) const {
  const float p = probability_to_overlap(light, place);
  return p > tree_.xi(light) ? p : 0;
}

float CullingSampler::assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory,
                                  const LightPlace& place, std::uint32_t /*random*/) const {
  const float weight = weight_in_any_range(light, receiver);
  if (!(weight > 0)) return 0;
  const float p = probability_to_overlap(light, place);
  if (settings_.range_samples == RangeNumbers::stratified) return p * weight / parameters_.stand_in_weight;
  // The choice completed by the light, as if it had overlapped in any case: a light's own range then says nothing about
  // the others that it was weighed against.
  const float total = memory.total_weight + (weight_in_range(light, receiver) > 0 ? 0 : weight);
  return p * weight / std::max(total, weight);
}

float CullingSampler::error_bound() const {
  return parameters_.radiance_floor * parameters_.exposure / (2 * std::numbers::pi_v<float>);  // delta = 2 pi eps
}

ChosenLight ListSampler::choose(const Receiver& receiver, Candidates& candidates, double u,
                                ChoiceMemory& memory) const {
  find_own_candidates(receiver, candidates);
  const std::uint32_t k = settings_.list_length;
  memory.overlapping = memory.listed = 0;
  f32::RandomWords random =
      f32::random_words(static_cast<std::uint32_t>(u * 0x1p32), 0, std::bit_cast<std::uint32_t>(receiver.position[0]),
                        std::bit_cast<std::uint32_t>(receiver.position[1]));
  weigh_in_chunks(candidates.rows, receiver, weighing(),
                  [&](const std::uint32_t* lights, const Vec3*, const float* weights, std::uint32_t count) {
                    for (std::uint32_t i = 0; i < count; ++i) {
                      if (!(weights[i] > 0)) continue;
                      std::uint32_t place = memory.listed;
                      ++memory.overlapping;
                      if (memory.listed < k) {
                        ++memory.listed;
                      } else {
                        random = f32::random_words(random.first, 0, random.second, memory.overlapping);
                        place = static_cast<std::uint32_t>((std::uint64_t(random.first) * memory.overlapping) >> 32u);
                        if (place >= k) continue;
                      }
                      memory.light[place] = lights[i], memory.weight[place] = weights[i];
                    }
                  });
  WeightedChoice choice(u);
  choice.add(memory.light.data(), nullptr, memory.weight.data(), memory.listed);
  memory.total_weight = choice.total();
  ChosenLight chosen = choice.chosen();
  chosen.pmf *= std::min(static_cast<float>(k) / static_cast<float>(std::max(memory.overlapping, 1u)), 1.0f);
  chosen.weighed = memory.overlapping;
  return chosen;
}

// The list completed by the light: were it among the overlapping and in the list, another would have left a full list.
float ListSampler::assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory,
                               const LightPlace& place, std::uint32_t random) const {
  const float weight = weight_in_any_range(light, receiver);
  if (!(weight > 0)) return 0;
  const auto k = static_cast<float>(settings_.list_length);
  const float p = probability_to_overlap(light, place);
  if (settings_.range_samples == RangeNumbers::stratified) return p * weight / parameters_.stand_in_weight;
  const bool overlaps = weight_in_range(light, receiver) > 0;
  const auto* end = memory.light.begin() + memory.listed;
  const bool listed = overlaps && std::find(memory.light.begin(), end, light) != end;
  const auto overlapping = static_cast<float>(memory.overlapping + (overlaps ? 0 : 1));
  float total = memory.total_weight;
  if (!listed) {
    total += weight;
    if (memory.listed == settings_.list_length) {
      total -= memory.weight[(std::uint64_t(random) * memory.listed) >> 32u];
    }
  }
  return p * std::min(k / overlapping, 1.0f) * weight / std::max(total, weight);
}

ClampedSampler::ClampedSampler(const LightSet& lights, const PathSettings& settings,
                               const CullingParameters& parameters)
    : CullingSampler(lights, settings, parameters) {
  tree_.clamp_all(parameters_.clamp_xi, parameters_.radiance_floor);
}

float ClampedSampler::acceptance(std::uint32_t light, const LightPlace& place) const {
  return probability_to_overlap(light, place) > tree_.xi(light) ? 1 : 0;
}

// A light that ends where its range does is not seen from farther away: nor by the rays of the BSDF.
float ClampedSampler::assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory,
                                  const LightPlace& place, std::uint32_t /*random*/) const {
  if (!(acceptance(light, place) > 0)) return std::numeric_limits<float>::infinity();
  return weight_in_any_range(light, receiver) / std::max(memory.total_weight, 1e-30f);
}

}  // namespace luciole
