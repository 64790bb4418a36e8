// SPDX-License-Identifier: Apache-2.0
// Weighs every light at every point: the least variance that these weights can give, and the measure of the others.
//                                                                                     [TH16] Fig. 10, "brute force"
#pragma once
#include "offline/light_sample/light_sampler.h"

namespace luciole {

class ExhaustiveSampler final : public LightSampler {
 public:
  ExhaustiveSampler(const LightSet& lights, Isa isa);
  ChosenLight choose(const Receiver& receiver, Candidates& candidates, double u, ChoiceMemory& memory) const override;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t random) const override;
  std::uint64_t memory_bytes() const override { return all_.memory_bytes(); }

 private:
  const LightSet& lights_;
  Isa isa_;
  LightRows all_;
};

}  // namespace luciole
