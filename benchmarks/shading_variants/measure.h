// SPDX-License-Identifier: Apache-2.0
// Times of all variants on one scene, taken in turns.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "benchmarks/shading_variants/comparison.h"
#include "benchmarks/stage.h"

namespace luciole {

struct VariantTimes {
  std::string name, what;
  // Medians over the frames; by kind of light and, last, of all kinds. No kinds apart: only the last.
  std::array<double, kLightKinds + 1> ms{}, to_first{};
  std::vector<Comparison> light;  // by kind
};

struct SceneTimes {
  std::string scene;
  Settings settings;
  std::vector<LightKind> kinds;                               // of which the scene has lights
  std::vector<VariantTimes> variants;                         // lights by pixel first
  std::vector<std::pair<std::string, std::string>> left_out;  // name, why
  double error_of_float = 0, error_of_half = 0;               // medians against double; 0: not known
};

// Shades all variants once, to check their light and so that drivers compile; then `frames` rounds of one after the
// other. An error if a variant gives other light than the first.
Result<SceneTimes> measure(gpu::Device& device, const PreparedStage& scene, std::uint32_t frames);

}  // namespace luciole
