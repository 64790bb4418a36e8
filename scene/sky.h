// SPDX-License-Identifier: Apache-2.0
// What is seen where a ray meets nothing.
#pragma once
#include <cstddef>
#include <cstdint>

#include "scene/scene.h"

namespace luciole {

// Radiance from infinitely far away, bilinear in the environment's image [W/(m^2 sr)].
//   direction  unit, from the eye to the sky
Vec3 sky_radiance(const Environment& environment, Vec3 direction);

// Of one texel of a row of the image [sr]: the band between two polar angles, cut into `width` parts.
double sky_texel_solid_angle(const Environment& environment, std::uint32_t row);

// A direction into a texel, uniform in its solid angle.
//   texel         row * width + column
//   across, down  numbers in [0,1)
//   returns       unit, from the scene to the sky
Vec3 sky_direction(const Environment& environment, std::size_t texel, double across, double down);

}  // namespace luciole
