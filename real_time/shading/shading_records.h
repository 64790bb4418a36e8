// SPDX-License-Identifier: Apache-2.0
// What the culling and shading kernel of the Vulkan engine reads and writes, shared with C++.
#ifndef LUCIOLE_SHADING_RECORDS_H
#define LUCIOLE_SHADING_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// A pixel of the geometry buffer: 64 bytes together, as the pixels of a sub-region lie n apart.
struct PixelRecord {
  float position[3];  // world [m]
  float depth;        // along the view [m]; infinity where the sky is seen
  float normal[3];
  float f90;
  float geometric_normal[3];
  float ggx_alpha;
  float f0[3];
  float unused;
};

// What the lights of one kind add to a pixel, before the weight n^2; demodulated (radiance.h).
struct PixelSums {
  float diffuse[3], specular[3];
  word_ listed;    // lights in the list of its depth half
  word_ accepted;  // of these, p > xi
};

// Of a tile and one kind of light.
struct TileCounts {
  word_ pixels[2];  // with a surface, in the near and the far half
  word_ listed[2];  // lights
  word_ accepted;   // light x pixel pairs
  word_ tests;      // lights that were asked whether they touch the tile
};

// Where a subset's lights of one kind lie.
struct SubsetRange {
  word_ begin, count;
};

struct ShadingPush {
  address_ pixels;       // PixelRecord
  address_ emitters;     // DiffuseEmitter, GlossyEmitter or ManyEmitter
  address_ bounds;       // BoundBlock
  address_ subsets;      // SubsetRange, n^2 of them
  address_ sums;         // PixelSums, of this kind of light
  address_ tile_counts;  // TileCounts, (subset row-major in the sub-regions, row, column)
  float eye[3], right[3], up[3];
  word_ width, height, interleave;
  word_ shift;                     // sub-region s sees subset (s + shift) mod n^2
  word_ first_light, light_count;  // which part of each subset: parts are added one after the other
};

// For kernels with shadow rays.
struct ShadowRecord {
  address_ scene;        // SceneRecord
  address_ unfinished;   // word: how many rays ended before they had asked everything on their way
  float surface_offset;  // RayScene::surface_offset [m]
  word_ unused;
};

// What they are told.
struct ShadowedShadingPush {
  ShadingPush shading;
  address_ shadows;  // ShadowRecord
};

#if defined(__cplusplus)
static_assert(sizeof(PixelRecord) == 64 && offsetof(PixelRecord, f0) == 48);
static_assert(sizeof(PixelSums) == 32 && sizeof(TileCounts) == 24 && sizeof(SubsetRange) == 8);
static_assert(sizeof(ShadowRecord) == 24 && offsetof(ShadowedShadingPush, shadows) == 112);
static_assert(sizeof(ShadowedShadingPush) <= 128);
static_assert(sizeof(ShadingPush) <= 128 && offsetof(ShadingPush, light_count) == 104);
#endif

LUCIOLE_RECORDS_END

#endif
