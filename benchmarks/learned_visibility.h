// SPDX-License-Identifier: Apache-2.0
// An experiment: culling whose weights know how often lights of a neighbourhood were visible from a neighbourhood of
// surface points. docs/decisions/0013-choice-of-lights-offline.md says what it gives.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "offline/light_sample/culling_sampler.h"
#include "offline/light_sample/weighted_choice.h"

namespace luciole {

class LearnedVisibilitySampler final : public CullingSampler {
 public:
  //   cell    edge of the cubes in which surface points share what they learn [m]
  //   lights  neighbours along the curve that share it
  LearnedVisibilitySampler(const LightSet& lights, const PathSettings& settings, const CullingParameters& parameters,
                           float cell, std::uint32_t block)
      : CullingSampler(lights, settings, parameters), cell_(cell), block_(block) {}

  void learn(const Receiver& receiver, std::uint32_t light, bool visible) {
    Seen& seen = table_[key(receiver, light)];
    ++seen.tried, seen.visible += visible ? 1 : 0;
  }

  ChosenLight choose(const Receiver& receiver, Candidates& candidates, double u, ChoiceMemory& memory) const override {
    find_own_candidates(receiver, candidates);
    WeightedChoice choice(u);
    float scaled[256];
    weigh_in_chunks(candidates.rows, receiver, weighing(),
                    [&](const std::uint32_t* lights, const Vec3* tints, const float* weights, std::uint32_t count) {
                      for (std::uint32_t k = 0; k < count; ++k) {
                        scaled[k] = weights[k] > 0 ? weights[k] * share(receiver, lights[k]) : 0.0f;
                      }
                      choice.add(lights, tints, scaled, count);
                    });
    memory.total_weight = choice.total();
    ChosenLight chosen = choice.chosen();
    chosen.colour_apart = {0, 0, 0};
    return chosen;
  }

  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t) const override {
    const float weight = weight_in_any_range(light, receiver) * share(receiver, light);
    if (!(weight > 0)) return 0;
    const float total = memory.total_weight + (weight_in_range(light, receiver) > 0 ? 0 : weight);
    return probability_to_overlap(light, place) * weight / std::max(total, weight);
  }

 private:
  struct Seen {
    std::uint32_t tried = 0, visible = 0;
  };

  std::uint64_t key(const Receiver& receiver, std::uint32_t light) const {
    std::uint64_t key = light / block_;
    for (const float x : receiver.position) {
      key = key * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / cell_)));
    }
    return key;
  }
  // Never zero, so that no light is lost; one half where nothing is known.
  float share(const Receiver& receiver, std::uint32_t light) const {
    const auto found = table_.find(key(receiver, light));
    if (found == table_.end()) return 0.5f;
    return (static_cast<float>(found->second.visible) + 0.5f) / (static_cast<float>(found->second.tried) + 1);
  }

  float cell_;
  std::uint32_t block_;
  std::unordered_map<std::uint64_t, Seen> table_;
};

}  // namespace luciole
