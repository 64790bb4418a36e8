// SPDX-License-Identifier: Apache-2.0
// What the example lights: a yard with crates under thousands of lamps, as a geometry buffer and a light buffer. The
// structs are those of the shaders, std430 layout.
#pragma once
#include <cstdint>
#include <vector>

struct Light {
  float position[3];    // [m]
  float range;          // [m]
  float intensity[3];   // [W/sr]
  float falloff_floor;  // [1/m^2]
};
struct Surface {
  float position[3];  // [m]
  float albedo;       // 0: nothing is seen
  float normal[3];
  float padding;
};
static_assert(sizeof(Light) == 32 && sizeof(Surface) == 32);

// What a camera above the yard sees; width * height, row 0 on top.
std::vector<Surface> see_yard(std::uint32_t width, std::uint32_t height);

//   max_error  standard deviation that one light may have in a pixel     [display units, exposure 1]
std::vector<Light> hang_lamps(std::uint32_t count, float max_error);
