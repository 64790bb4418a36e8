// SPDX-License-Identifier: Apache-2.0
// What the kernel of temporal accumulation reads and writes beside pixels and sums, shared with C++.
#ifndef LUCIOLE_ACCUMULATION_RECORDS_H
#define LUCIOLE_ACCUMULATION_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// Pixels that a workgroup makes.
const int kAccumulationGroupColumns = 32, kAccumulationGroupRows = 4;

// What a pixel saw, and how many frames its means count.
struct PastSurfaceRecord {
  float position[3];
  float diffuse_frames;  // 0: nothing to go on from
  float normal[3];
  float specular_frames;
  float geometric_normal[3];
  word_ material;
};

struct AccumulationCounts {
  word_ not_finite, many_not_finite;  // pixels whose light of this frame is not: indirect light, that of many lights
};

// Of a frame. Addresses are 0 for what is not there.
struct AccumulationFrame {
  address_ pixels;                                                // PixelRecord
  address_ surfaces;                                              // SurfaceRecord
  address_ sums, more_sums, many_sums;                            // PixelSums
  address_ past_surfaces;                                         // PastSurfaceRecord
  address_ past_indirect, past_many;                              // PixelSums of weight 1
  address_ present_surfaces;                                      // and where those of this frame go
  address_ present_indirect, present_many;                        // likewise
  address_ frames;                                                // float per pixel
  address_ counts;                                                // AccumulationCounts, from 0
  float eye[3];                                                   // of now [m]
  float past_eye[3], past_right[3], past_up[3], past_forward[3];  // PastView (reprojection.h)
  float past_pixel_size, past_sub_pixel_x, past_sub_pixel_y;
  word_ way_back;  // WayBack (past_view.h)
  float weight;    // of the sums, n^2
  float most;      // frames of the past that count
  word_ width, height;
  word_ unused;
};

struct AccumulationPush {
  address_ frame;  // AccumulationFrame
};

#if defined(__cplusplus)
static_assert(sizeof(PastSurfaceRecord) == 48 && sizeof(AccumulationCounts) == 8);
static_assert(sizeof(AccumulationFrame) == 200 && offsetof(AccumulationFrame, height) == 192);
static_assert(sizeof(AccumulationPush) == 8);
#endif

LUCIOLE_RECORDS_END

#endif
