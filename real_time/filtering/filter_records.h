// SPDX-License-Identifier: Apache-2.0
// What the filter's kernel of the Vulkan engine reads and writes beside pixels and their sums
// (shading/shading_records.h), shared with C++; and what both filters agree upon.
#ifndef LUCIOLE_FILTER_RECORDS_H
#define LUCIOLE_FILTER_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

const int kLargestFilterRadius = 8;  // half the kernel's width or height [pixels]
// Pixels that a workgroup of filter_pixels.comp makes.
const int kFilterGroupColumns = 16, kFilterGroupRows = 32;
// Stands for 1/depth [1/m] where a pixel must not contribute: no weight survives it.
const float kNoInverseDepth = -1e18f;

// Light of a pixel, demodulated as in radiance.h.
struct PixelLight {
  float diffuse[3], specular[3];
};

struct FilterCounts {
  word_ not_finite;  // pixels whose noisy light is not
};

struct FilterPush {
  address_ pixels;                    // PixelRecord
  address_ sums, more_sums;           // PixelSums; more_sums is 0 where the light is of one kind of lobe alone
  address_ filtered;                  // PixelLight
  address_ counts;                    // FilterCounts, from 0
  float right[3], up[3], forward[3];  // the camera's axes, unit
  float footprint;                    // width of a pixel at depth 1 [1]
  float left_edge, top_edge;          // where the sample of pixel (0, 0) lies from the axis [pixels right, down]
  float weight;                       // of the sums: n^2, or 1 where they have it already
  word_ width, height;
  word_ unused;
};

#if defined(__cplusplus)
static_assert(sizeof(PixelLight) == 24 && sizeof(FilterCounts) == 4);
static_assert(sizeof(FilterPush) == 104 && offsetof(FilterPush, height) == 96);
#endif

LUCIOLE_RECORDS_END

#endif
