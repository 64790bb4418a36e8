// SPDX-License-Identifier: Apache-2.0
// The filter's kernels of each instruction set, and what they are handed: plain values and pointers only.
#pragma once
#include <cstddef>
#include <cstdint>

#include "real_time/filtering/filter_radius.h"

namespace luciole {

// The whole picture. Planes may be read 64 bytes past their end (base/aligned_vector.h).
struct FilterPicture {
  int width = 0, height = 0;
  FilterRadius radius;
  const float* depth = nullptr;
  const float* ggx_alpha = nullptr;
  const float *normal[3] = {}, *geometric_normal[3] = {}, *f0[3] = {};
  const float* noisy[6] = {};  // diffuse r, g, b, specular r, g, b
  float* clean[6] = {};
  float right[3] = {}, up[3] = {}, forward[3] = {};  // the camera's axes, unit
  float footprint = 0;                               // width of a pixel at depth 1 [1]
  float left_edge = 0, top_edge = 0;  // where the sample of pixel (0, 0) lies from the axis [pixels right, down]
};

// A tile of the picture is filtered from a copy of it and its apron, in which a row holds one line per quantity below.
// 64 x 64 pixels and apron are 368 KB and stay in the second cache; what 16 pixels side by side reach (39 KB) stays in
// the first while the filter walks down the tile.
inline constexpr int kFilterTile = 64;
inline constexpr int kFilterLine = kFilterTile + 2 * kLargestFilterRadius + 16;  // 16: the widest register's overhang
enum FilterQuantity : int {
  kInverseDepth,  // [1/m]; kNoInverseDepth for the sky, outside the picture and where the light is not finite
  kNormalX,
  kNormalY,
  kNormalZ,
  kAlpha,
  kReflectsDiffusely,  // 1 or 0
  kDiffuseR,
  kDiffuseG,
  kDiffuseB,  // demodulated, less the lowest value of the tile; 0 where not kReflectsDiffusely
  kSpecularR,
  kSpecularG,
  kSpecularB,
  kFilterQuantities
};
inline constexpr int kFilterRow = kFilterQuantities * kFilterLine;
inline constexpr std::size_t kFilterScratch = std::size_t(kFilterRow) * (kFilterTile + 2 * kLargestFilterRadius);

struct FilterTile {
  int x = 0, y = 0, width = 0, height = 0;  // of the pixels to make
  float* scratch = nullptr;                 // kFilterScratch floats, 64-byte aligned
  float lowest[6] = {};                     // what was taken off the light
};

// Declares, in the namespace of one instruction set:
//   gather_tile  fills tile.scratch and tile.lowest
//   filter_tile  writes picture.clean where the tile is, from a gathered tile
#define LUCIOLE_DECLARE_FILTER_KERNELS(isa)                               \
  namespace isa {                                                         \
  void gather_tile(const FilterPicture& picture, FilterTile& tile);       \
  void filter_tile(const FilterPicture& picture, const FilterTile& tile); \
  }
LUCIOLE_DECLARE_FILTER_KERNELS(avx512)
LUCIOLE_DECLARE_FILTER_KERNELS(avx2)
LUCIOLE_DECLARE_FILTER_KERNELS(baseline)
#undef LUCIOLE_DECLARE_FILTER_KERNELS

}  // namespace luciole
