// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/exhaustive_sampler.h"

#include "offline/light_sample/weighted_choice.h"

namespace luciole {

ExhaustiveSampler::ExhaustiveSampler(const LightSet& lights, Isa isa) : lights_(lights), isa_(isa) {
  for (std::uint32_t i = 0; i < lights.size(); ++i) all_.add(i, lights.records()[i], lights.tint(i), 0);
}

ChosenLight ExhaustiveSampler::choose(const Receiver& receiver, Candidates&, double u, ChoiceMemory& memory) const {
  WeightedChoice choice(u);
  choice.add(all_, receiver, {Weight::reflected, 0, isa_});
  memory.total_weight = choice.total();
  return choice.chosen();
}

float ExhaustiveSampler::assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory,
                                     const LightPlace&, std::uint32_t) const {
  const float weight = weight_of(lights_.records()[light], 0, receiver, {Weight::reflected, 0, isa_});
  return weight > 0 ? weight / memory.total_weight : 0;
}

}  // namespace luciole
