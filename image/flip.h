// SPDX-License-Identifier: Apache-2.0
// How different two pictures look when one flips between them.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace luciole {

// The observer of Andersson et al. 2020, section 4: a screen 0.7 m wide with 3,840 pixels, seen from 0.7 m.
inline constexpr float kFlipPixelsPerDegree = 67.0206433f;

// Per-pixel difference in [0,1], row 0 on top; 0 for equal pictures, symmetric in its arguments.
// LDR-FLIP: P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", HPG 2020.
//   a, b               display-linear Rec. 709 in [0,1] (after exposure and tone curve), width * height pixels
//   pixels_per_degree  of visual angle at the observer's place, > 0
std::vector<float> flip_map(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::uint32_t width,
                            std::uint32_t height, float pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace luciole
