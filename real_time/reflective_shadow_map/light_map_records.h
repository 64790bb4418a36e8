// SPDX-License-Identifier: Apache-2.0
// The lights' maps as the kernel that traces their texels reads them, and what it is told; shared with C++.
#ifndef LUCIOLE_LIGHT_MAP_RECORDS_H
#define LUCIOLE_LIGHT_MAP_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

const word_ kPointMap = 0u, kSpotMap = 1u, kSunMap = 2u;  // PunctualLight::Kind

// A LightMap. Its texels are those from first_texel on, in the order of its CellPartition.
struct LightMapRecord {
  word_ kind;
  word_ first_texel, texels;
  word_ rows;                      // of the partition
  float origin[3];                 // the light; of a sun the corner of its rectangle [m]
  float right[3], up[3], axis[3];  // unit; axis away from the light
  float width, height;             // of a sun's rectangle [m]
  float cos_outer, ramp;           // of a spot
  float flux[3];                   // of a texel on the axis [W]
  float solid_angle;               // of a texel [sr]; 0 for a sun
  float parallel_area;             // of a texel [m^2]; 0 for a point or spot light
};

// CellPartition::Cell of every texel of all maps.
struct CellRecord {
  word_ row, column;
};

struct LightMapPush {
  address_ scene;       // SceneRecord
  address_ maps;        // LightMapRecord
  address_ cells;       // CellRecord, per texel
  address_ lights;      // VplRecord, per texel; is_light 0 where nothing is reflected
  address_ counts;      // word per subset: its lights
  address_ unfinished;  // word: how many rays ended before they had asked everything on their way
  word_ map_count, texel_count;
  word_ subsets;      // n^2
  word_ is_random;    // 0: rays go through the centres of texels
  word_ seed, frame;  // else they are drawn by these
};

#if defined(__cplusplus)
static_assert(sizeof(LightMapRecord) == 100 && sizeof(CellRecord) == 8);
static_assert(sizeof(LightMapPush) <= 128 && offsetof(LightMapPush, frame) == 68);
#endif

LUCIOLE_RECORDS_END

#endif
