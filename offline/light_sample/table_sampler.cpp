// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/table_sampler.h"

#include <algorithm>
#include <numbers>

namespace luciole {
namespace {

// Up to a common factor [W]: integral of the directional factor over all directions.
double flux_of(const LightRecord& light) {
  constexpr double kPi = std::numbers::pi;
  if (light.lamp == 0) return kPi * light.intensity * (1 + light.two_sided);
  if (light.scale == 0) return 4 * kPi * light.intensity;
  // A spot: the full cone, and a third of its ramp. t = cos * scale + offset is 0 at the outer cone, 1 at the inner.
  const double ramp = 1 / light.scale, outer = -light.offset / light.scale;
  return 2 * kPi * light.intensity * (std::max(1 - (outer + ramp), 0.0) + ramp / 3);
}

}  // namespace

TableSampler::TableSampler(const LightSet& lights, By by) : sums_(lights.size()) {
  double sum = 0;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    sum += by == By::flux ? flux_of(lights.records()[i]) : 1.0;
    sums_[i] = sum;
  }
  for (double& running : sums_) running /= sum;
}

ChosenLight TableSampler::choose(const Receiver& receiver, Candidates&, double u, ChoiceMemory& memory) const {
  if (sums_.empty()) return {};
  const auto found = std::upper_bound(sums_.begin(), sums_.end() - 1, u);
  const auto light = static_cast<std::uint32_t>(found - sums_.begin());
  return {light, assumed_pmf(light, receiver, memory, {}, 0), 1};
}

float TableSampler::assumed_pmf(std::uint32_t light, const Receiver&, const ChoiceMemory&, const LightPlace&,
                                std::uint32_t) const {
  return static_cast<float>(sums_[light] - (light > 0 ? sums_[light - 1] : 0.0));
}

}  // namespace luciole
