// SPDX-License-Identifier: Apache-2.0
// What the kernels of the rivals of tiled culling read and write, shared with C++. Tiles are numbered (sub-region
// row-major, row, column); a tile has 32 parts, its clusters, or 16, its cells of 4x4 pixels.
#ifndef LUCIOLE_LIST_RECORDS_H
#define LUCIOLE_LIST_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// What splatting asks of a cell's pixels. A depth below 0: no surface.
struct SplatCell {
  float x[16], y[16];  // slopes right/forward and up/forward
  float depth[16];     // [m]
  float nearest;       // the least depth of a surface; only of cells that show one
};

// Of a tile and one kind of light.
struct PartCounts {
  word_ pixels[32];  // with a surface, per part
  word_ listed[32];  // lights in the part's list
  word_ pairs;       // light x pixel: of clusters those of the lists, of splats where the light covers the pixel
  word_ accepted;    // pairs with p > xi
  word_ tests;       // as proxy_kernel.h counts them; those of a light itself stand with its sub-region's first tile
};

// Of find_depths.comp and find_parts.comp.
struct PartPush {
  address_ pixels;    // PixelRecord
  address_ depths;    // two words: bits of the nearest depth, all inverted, and of the farthest; 0, 0: no surface
  address_ occupied;  // word per tile: a bit per part that shows a surface
  address_ cells;     // SplatCell, 16 per tile
  float eye[3], right[3], up[3];
  word_ width, height, interleave;
};

// Of mark_clusters.comp and mark_splats.comp.
struct MarkPush {
  address_ bounds;   // BoundBlock
  address_ subsets;  // SubsetRange
  address_ depths, occupied, cells;
  address_ proxy;     // IcosahedronProxy or GeodesicProxy
  address_ lists;     // `words` words per part: bit i is light first_light + i of the sub-region's subset
  address_ covering;  // per pixel in the tiles' order, 16 bits: how many of these lights cover it
  address_ counts;    // PartCounts
  float pixel;        // slope from one pixel to the next
  word_ width, height, interleave;
  word_ shift;        // as ShadingPush
  word_ first_light;  // of the window; a workgroup each
  word_ words;
};

// Of shade_lists.comp.
struct ListShadingPush {
  address_ pixels, emitters, subsets, sums;  // as ShadingPush
  address_ depths, lists, covering, counts;  // as MarkPush
  float eye[3];
  word_ width, height, interleave, shift;
  word_ first_light, words;
};

// Of its kernel with shadow rays.
struct ShadowedListShadingPush {
  ListShadingPush shading;
  address_ shadows;  // ShadowRecord (shading_records.h)
};

#if defined(__cplusplus)
static_assert(sizeof(SplatCell) == 196 && sizeof(PartCounts) == 268);
static_assert(sizeof(PartPush) <= 128 && offsetof(PartPush, interleave) == 76);
static_assert(sizeof(MarkPush) <= 128 && offsetof(MarkPush, words) == 96);
static_assert(sizeof(ListShadingPush) <= 128 && offsetof(ListShadingPush, words) == 96);
static_assert(sizeof(ShadowedListShadingPush) <= 128 && offsetof(ShadowedListShadingPush, shadows) == 104);
#endif

LUCIOLE_RECORDS_END

#endif
