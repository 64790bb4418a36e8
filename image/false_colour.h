// SPDX-License-Identifier: Apache-2.0
// Colours that stand for numbers, for maps of errors.
#pragma once
#include <vector>

#include "base/vector.h"

namespace luciole {

// Display-linear Rec. 709 colour of a value in [0,1]; what is beyond counts as the end, what is not a number as 1.
// Black, blue, violet, red, orange, pale yellow: the lightness L* grows evenly from 0 to 96, so that a print in grey
// and an eye that cannot tell red from green see the same order.
Vec3 false_colour(float value);

// Relative errors lie on a logarithmic scale that is the same for all pictures, so that maps can be held side by side.
inline constexpr float kLowestError = 1e-3f, kHighestError = 10;

// Where a relative error lies on that scale: 0 at kLowestError and below, 1 at kHighestError and above.
float error_scale(float relative_error);

// Maps for write_png, of DifferenceMaps (metrics.h): relative errors on their scale, FLIP from 0 to 1 as it is.
std::vector<Vec3> error_colours(const std::vector<float>& relative_error);
std::vector<Vec3> flip_colours(const std::vector<float>& flip);

}  // namespace luciole
