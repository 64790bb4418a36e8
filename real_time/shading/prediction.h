// SPDX-License-Identifier: Apache-2.0
// Pass for tests and references: what the estimate of one frame must be, and how much it may scatter, per pixel.
#pragma once
#include "real_time/shading/shading_pass.h"

namespace luciole {

struct Prediction {
  Plane3 reference;  // radiance by all lights, without culling, roulette or interleaving [W/(m^2 sr)]
  Plane3 variance;   // of one unfiltered frame around it, interleaving included
  Plane accepted;    // lights that a pixel accepts per frame, on average
};

// Slow: every light at every pixel. `inputs` as for shade(), with stochastic ranges.
Prediction predict(const ShadingInputs& inputs);

}  // namespace luciole
