// SPDX-License-Identifier: Apache-2.0
// The registry: a name of the settings becomes a sampler.
#pragma once
#include <memory>
#include <vector>

#include "offline/light_sample/light_sampler.h"
#include "offline/light_set/light_set.h"
#include "offline/light_tree/range_tree.h"

namespace luciole {

struct SamplerInputs {
  const Scene& scene;
  const LightSet& lights;
  const PathSettings& settings;            // isa resolved
  const std::vector<Receiver>& receivers;  // surface points of paths traced ahead: what ranges are fitted to
  float scene_diagonal;                    // [m]
};

// lights and scene must outlive the sampler.
std::unique_ptr<LightSampler> make_light_sampler(const SamplerInputs& inputs);

// The constant xi with which as many lights are accepted at a receiver, on average, as with random ones: equal cost.
float fitted_clamp(const LightSet& lights, const std::vector<Receiver>& receivers, float radiance_floor);

// The radiance floor that lets `wanted` lights be accepted at a receiver, on average.   [W/(m^2 sr)]
float fitted_radiance_floor(const LightSet& lights, const std::vector<Receiver>& receivers, double wanted);

// Lights that overlap a receiver in the ranges that the tree holds, on average: what a choice weighs.
double mean_weighed(const RangeTree& tree, const std::vector<Receiver>& receivers, Isa isa);

// The sphere of a range also holds lights that face away from a receiver or lie below its horizon: near strips of many
// small triangles ten for each that is accepted.
inline constexpr double kMostWeighed = 32;

// `floor`, or a higher one with which no more than kMostWeighed are weighed for a choice, on average.
float affordable_radiance_floor(const SamplerInputs& inputs, float floor);

}  // namespace luciole
