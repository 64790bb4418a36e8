// SPDX-License-Identifier: Apache-2.0
// Whether two kernels gave the same light.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "benchmarks/shading_variants/variants.h"

namespace luciole {

struct Comparison {
  bool same_bits = true;         // of light and accepted lights, at all pixels with a surface
  std::size_t other_lights = 0;  // pixels that accepted another number of lights; what follows is of all others
  double accepted = 0;           // pairs of a light and a pixel, in all
  double relative_mse = 0;       // of diffuse * albedo + specular: mean square of the difference over that of the value
  double largest_in_roundings = 0;  // difference, in units of what another order of that many terms can make
};

//   found  the sums of the variant
Comparison compare(const GeometryBuffer& geometry, const std::vector<PixelSums>& engine,
                   const std::vector<PixelSums>& found);

// What factors of 11 bits can make of relative_mse.
double most_of_half_precision();

// What is wrong with a variant's sums; empty: nothing. Drivers may translate two kernels otherwise, so that bits differ
// and a light at the edge of its range is accepted by one alone; so many of those as must be expected are let pass.
std::string complaint(const Comparison& comparison);

// What a variant promises where the driver translates both alike, as software Vulkan does; empty: it is kept.
std::string broken_promise(const Comparison& comparison, Agreement agreement);

}  // namespace luciole
