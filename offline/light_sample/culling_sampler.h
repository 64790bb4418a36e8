// SPDX-License-Identifier: Apache-2.0
// Stochastic light culling: of the lights whose range of this pass holds the point one by weight.   [TH16] sect. 5
#pragma once
#include "offline/light_sample/light_sampler.h"
#include "offline/light_sample/weighted_choice.h"
#include "offline/light_tree/range_tree.h"

namespace luciole {

struct CullingParameters {
  float radiance_floor = 0;   // delta / E [W/(m^2 sr)]
  float exposure = 1;         // E, for the report of the error bound
  float stand_in_weight = 0;  // C: mean total weight, for stratified ranges
  float scene_diagonal = 0;   // [m]
  float clamp_xi = 0.5f;      // of every light, if ranges are clamped
};

// Weighs all lights that overlap.
class CullingSampler : public LightSampler {
 public:
  CullingSampler(const LightSet& lights, const PathSettings& settings, const CullingParameters& parameters);

  void begin_pass(std::uint64_t pass) override;
  void share_candidates(const Receiver* receivers, std::uint32_t count, Candidates& candidates) const override;
  ChosenLight choose(const Receiver& receiver, Candidates& candidates, double u, ChoiceMemory& memory) const override;
  float acceptance(std::uint32_t light, const LightPlace& place) const override;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t random) const override;
  std::uint64_t memory_bytes() const override { return tree_.memory_bytes(); }
  float error_bound() const override;

 protected:
  // Adds the receiver's own lights to the shared ones.
  void find_own_candidates(const Receiver& receiver, Candidates& candidates) const;
  void add_overlapping(const WalkBounds& bounds, LightRows& rows) const;
  // Whatever the light's range is; and 0 where it does not reach.
  float weight_in_any_range(std::uint32_t light, const Receiver& receiver) const;
  float weight_in_range(std::uint32_t light, const Receiver& receiver) const;
  Weighing weighing() const { return {weight_, parameters_.radiance_floor, settings_.isa}; }
  // p, [TH17] Eq. 2 with the mean intensity of the channels.
  float probability_to_overlap(std::uint32_t light, const LightPlace& place) const;

  const LightSet& lights_;
  PathSettings settings_;
  CullingParameters parameters_;
  Weight weight_;
  RangeTree tree_;
};

// Keeps k of them.   [TH16] Algorithm 3
class ListSampler : public CullingSampler {
 public:
  using CullingSampler::CullingSampler;
  ChosenLight choose(const Receiver& receiver, Candidates& candidates, double u, ChoiceMemory& memory) const override;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t random) const override;
};

// The rival of [TH16] Figs. 9 and 10: one constant range for all lights, and no division by a probability. Too dark.
class ClampedSampler final : public CullingSampler {
 public:
  ClampedSampler(const LightSet& lights, const PathSettings& settings, const CullingParameters& parameters);
  void begin_pass(std::uint64_t) override {}
  float acceptance(std::uint32_t light, const LightPlace& place) const override;
  float assumed_pmf(std::uint32_t light, const Receiver& receiver, const ChoiceMemory& memory, const LightPlace& place,
                    std::uint32_t random) const override;
};

}  // namespace luciole
