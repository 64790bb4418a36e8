// SPDX-License-Identifier: Apache-2.0
// What is seen where a ray meets nothing.
#pragma once
#include "scene/scene.h"

namespace luciole {

// Radiance from infinitely far away, bilinear in the environment's image [W/(m^2 sr)].
//   direction  unit, from the eye to the sky
Vec3 sky_radiance(const Environment& environment, Vec3 direction);

}  // namespace luciole
