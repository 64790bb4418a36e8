// SPDX-License-Identifier: Apache-2.0
// Pass: an environment image -> directional lights that stand for it. They are primary lights like any other: each gets
// its part of the reflective shadow map, its virtual point lights and its shadow rays.
#pragma once
#include <cstdint>

#include "real_time/reflective_shadow_map/primary_light.h"
#include "scene/scene.h"

namespace luciole {

struct SkySampling {
  std::uint32_t lights = 16;  // how many directions stand for the sky in one frame
  std::uint64_t seed = 0;     // 0 without jitter: fixed places in the strata, for a still picture
  std::uint64_t frame = 0;
  bool jitter = false;  // new directions each frame: their mean is the whole sky
};

// Directions drawn by the image's luminance, one in each of `lights` equal strata of it: every light carries the same
// share of the sky's luminance, and the mean over jittered frames is the image's light, exactly. A constant environment
// (no image) is a background only: no lights. Directional lights: `direction` is where the light goes, `intensity` its
// irradiance [W/m^2].
PrimaryLights sample_sky(const Environment& environment, const SkySampling& sampling);

}  // namespace luciole
