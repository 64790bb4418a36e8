// SPDX-License-Identifier: Apache-2.0
// What the kernels of direct light read, on both engines, and what the device's is told.
#ifndef LUCIOLE_DIRECT_RECORDS_H
#define LUCIOLE_DIRECT_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// A point, spot or directional light: PunctualSource (equations/punctual_light.h).
struct DirectSource {
  word_ sun;  // 1, else 0
  float position[3], direction[3], colour[3];
  float scale, offset;
};

// Sources are added a few at a time, in order.
struct DirectPush {
  address_ scene;       // SceneRecord
  address_ pixels;      // PixelRecord
  address_ surfaces;    // SurfaceRecord
  address_ sources;     // DirectSource
  address_ radiance;    // 3 floats per pixel, written for the first source and added to for later ones
  address_ unfinished;  // word: how many shadow rays ended before they had asked everything on their way
  float eye[3];
  float surface_offset;  // RayScene::surface_offset [m]
  word_ pixel_count;
  word_ first_source, source_count;
  word_ unused;
};

#if defined(__cplusplus)
static_assert(sizeof(DirectSource) == 48);
static_assert(sizeof(DirectPush) <= 128 && offsetof(DirectPush, source_count) == 72);
#endif

LUCIOLE_RECORDS_END

#endif
