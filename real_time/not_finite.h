// SPDX-License-Identifier: Apache-2.0
// Rare bad arithmetic in the light of pixels: found, taken out of the picture, and counted.
#pragma once
#include <cstdint>
#include <vector>

#include "real_time/shading/radiance.h"

namespace luciole {

// How many pixels have a value that is not finite; 0 where the planes are empty.
std::uint64_t count_not_finite(const Radiance& light);

// Makes pixels black that have such a value. Returns how many.
std::uint64_t blacken_not_finite(std::vector<Vec3>& picture);

}  // namespace luciole
