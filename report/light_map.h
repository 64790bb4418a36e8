// SPDX-License-Identifier: Apache-2.0
// Lights per pixel as a picture: brightness is how many, hue how many of them in vain ([TH17] Figs. 9 and 10).
#pragma once
#include <vector>

#include "base/result.h"
#include "image/image.h"

namespace luciole {

inline constexpr float kBrightestLightCount = 256;  // as in the paper

// Display-linear colour of a pixel with `listed` lights, `in_vain` of them false positives. Blue: none is in vain, over
// green and yellow to red: all are. Black: no light.
Vec3 light_colour(float listed, float in_vain);

// Of the layers lights_listed and lights_false; refuses a file without them.
Result<std::vector<Vec3>> light_map(const Image& image);

}  // namespace luciole
