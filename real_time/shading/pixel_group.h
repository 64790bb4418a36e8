// SPDX-License-Identifier: Apache-2.0
// Pixels as the shading kernels see them: groups of 16, structure of arrays. A group holds neighbouring pixels of one
// sub-region tile, all of one part of it; lanes without a pixel repeat the group's first one and are never written
// back.
#pragma once
#include <cstdint>

namespace luciole {

inline constexpr int kGroupPixels = 16;

struct alignas(64) PixelGroup {
  float position[3][kGroupPixels];  // world [m]
  float normal[3][kGroupPixels];    // shading normal
  float geometric_normal[3][kGroupPixels];
  float to_eye[3][kGroupPixels];  // unit
  float f0[3][kGroupPixels];
  float f90[kGroupPixels];
  float ggx_alpha[kGroupPixels];
  float view_low[3], view_high[3];    // box round the pixels in view space (right, up, forward) [m]
  std::uint32_t pixel[kGroupPixels];  // row-major index in the screen
  std::uint32_t count;                // pixels in use
  std::uint32_t part;  // what it belongs to: depth half 0 near, 1 far; or number of a part (tile_parts.h)
};

// What a list of lights adds to a group: demodulated light of one kind of lobe (see Radiance), and counts.
struct alignas(64) GroupRadiance {
  float diffuse[3][kGroupPixels];
  float specular[3][kGroupPixels];
  float accepted[kGroupPixels];  // lights with p > xi
};

}  // namespace luciole
