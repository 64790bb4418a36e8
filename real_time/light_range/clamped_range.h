// SPDX-License-Identifier: Apache-2.0
// The rival's ranges: one constant xi for all lights, found so that a pixel accepts as many lights as with stochastic
// ranges, at equal cost therefore ([TH16] Figs. 1, 4, 5).
#pragma once
#include "real_time/shading/shading_pass.h"

namespace luciole {

// inputs  lights reached with stochastic ranges. Looks at every light from a sample of the pixels: some seconds.
float clamped_xi(const ShadingInputs& inputs);

}  // namespace luciole
