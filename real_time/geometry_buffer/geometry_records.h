// SPDX-License-Identifier: Apache-2.0
// What the kernel of the geometry buffer writes beside PixelRecord (shading_records.h), and what it is told; shared
// with C++.
#ifndef LUCIOLE_GEOMETRY_RECORDS_H
#define LUCIOLE_GEOMETRY_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// Of a pixel: what the passes after shading ask for, and which point of which triangle it shows.
struct SurfaceRecord {
  float diffuse_albedo[3];
  float emission[3];     // towards the viewer [W/(m^2 sr)]; the sky where there is no surface
  word_ material;        // 0xffffffff for the sky
  word_ mesh, triangle;  // likewise
  float u, v;            // barycentric
  word_ unused;
};

// The rays are those of ScreenRays (pixel_block.h).
struct GeometryPush {
  address_ scene;       // SceneRecord
  address_ pixels;      // PixelRecord
  address_ surfaces;    // SurfaceRecord
  address_ unfinished;  // word: how many rays ended before they had asked everything on their way
  float eye[3], forward[3], top_left[3], across[3], down[3];
  float pixel_size;
  word_ width, height;
};

#if defined(__cplusplus)
static_assert(sizeof(SurfaceRecord) == 48);
static_assert(sizeof(GeometryPush) <= 128 && offsetof(GeometryPush, height) == 100);
#endif

LUCIOLE_RECORDS_END

#endif
