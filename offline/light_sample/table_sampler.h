// SPDX-License-Identifier: Apache-2.0
// Choices that do not look at the receiver: every light alike, or by flux.
#pragma once
#include <vector>

#include "offline/light_sample/light_sampler.h"

namespace luciole {

class TableSampler final : public LightSampler {
 public:
  enum class By : std::uint8_t { count, flux };
  TableSampler(const LightSet& lights, By by);

  ChosenLight choose(const Receiver& receiver, Candidates& candidates, double u, ChoiceMemory& memory) const override;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t random) const override;
  std::uint64_t memory_bytes() const override { return sums_.size() * sizeof(double); }

 private:
  std::vector<double> sums_;  // running sums of the probabilities
};

}  // namespace luciole
