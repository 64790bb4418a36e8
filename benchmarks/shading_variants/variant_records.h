// SPDX-License-Identifier: Apache-2.0
// What the variants of shade_tiles.comp read beside what that kernel reads, shared with C++.
#ifndef LUCIOLE_VARIANT_RECORDS_H
#define LUCIOLE_VARIANT_RECORDS_H
#include "real_time/shading/shading_records.h"

LUCIOLE_RECORDS_BEGIN

struct VariantPush {
  ShadingPush shading;
  address_ more;     // of the variant: lists in memory, a counter of tiles, or a ShadingPush per kind of light
  word_ tiles_each;  // how many tiles a persistent workgroup takes at most
  word_ unused;
};

// Ahead of a tile's two lists in memory, each of which has room for ShadingPush::light_count lights.
struct ListHeader {
  float middle;     // depth that parts the halves [m]
  word_ pixels[2];  // with a surface, per half
  word_ listed[2];  // lights, per half
  word_ asked;      // lights of the subset
};

#if defined(__cplusplus)
static_assert(sizeof(VariantPush) == 128 && offsetof(VariantPush, more) == 112);
static_assert(sizeof(ListHeader) == 24);
#endif

LUCIOLE_RECORDS_END

#endif
