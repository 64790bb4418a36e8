// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/exhaustive_sampler.h"

#include <algorithm>
#include <numeric>

#include "offline/light_sample/weighted_choice.h"

namespace luciole {

ExhaustiveSampler::ExhaustiveSampler(const LightSet& lights, Isa isa)
    : lights_(lights), isa_(isa), index_(lights.size()) {
  std::iota(index_.begin(), index_.end(), 0u);
}

void ExhaustiveSampler::weigh(const std::uint32_t* lights, std::uint32_t count, const Receiver& receiver,
                              float* weights) const {
  LUCIOLE_FOR_ISA(
      isa_, weigh_lights(lights_.records().data(), lights, count, receiver, Weight::reflected, PassRanges{}, weights));
}

ChosenLight ExhaustiveSampler::choose(const Receiver& receiver, double u, ChoiceMemory& memory) const {
  constexpr std::uint32_t kChunk = 256;
  WeightedChoice choice(u);
  float weights[kChunk];
  for (std::uint32_t first = 0; first < lights_.size(); first += kChunk) {
    const std::uint32_t count = std::min(kChunk, lights_.size() - first);
    weigh(&index_[first], count, receiver, weights);
    choice.add(&index_[first], weights, count);
  }
  memory.total_weight = choice.total();
  return choice.chosen();
}

float ExhaustiveSampler::assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory,
                                     const LightPlace&, std::uint32_t) const {
  float weight = 0;
  weigh(&light, 1, receiver, &weight);
  return weight > 0 ? weight / memory.total_weight : 0;
}

}  // namespace luciole
