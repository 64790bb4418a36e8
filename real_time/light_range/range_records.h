// SPDX-License-Identifier: Apache-2.0
// What the range kernels of the Vulkan engine read, shared with C++.
#ifndef LUCIOLE_RANGE_RECORDS_H
#define LUCIOLE_RANGE_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// A virtual point light (virtual_point_lights.h).
struct VplRecord {
  float position[3], normal[3], geometric_normal[3], incident[3], flux[3], diffuse_albedo[3], f0[3];
  float f90, ggx_alpha, area;
  word_ key;
  word_ is_light;  // 0: fills up a subset to a multiple of 16, reaches nothing
};

// A punctual light or a point of an emitting triangle (many_lights.h).
struct ManyLightRecord {
  float position[3], axis[3], intensity[3];
  float scale, offset, two_sided, squared, area;
  word_ key;
  word_ is_light;
};

// The same for all lights of a frame (RangeParameters).
struct RangeFrame {
  float exposure_over_delta;
  word_ seed, frame;
  float constant_xi;
  word_ stratified, stratum_shift;
  word_ disc;
  word_ subsets;  // n^2
  float eye[3], right[3], up[3], forward[3];
};

struct RangePush {
  address_ frame;     // RangeFrame
  address_ lights;    // VplRecord or ManyLightRecord, in the order of the emitters
  address_ emitters;  // DiffuseEmitter, GlossyEmitter or ManyEmitter
  address_ bounds;    // BoundBlock
  word_ count;        // of entries, a multiple of 16
  word_ unused;
};

#if defined(__cplusplus)
static_assert(sizeof(VplRecord) == 104 && offsetof(VplRecord, key) == 96);
static_assert(sizeof(ManyLightRecord) == 64 && offsetof(ManyLightRecord, key) == 56);
static_assert(sizeof(RangeFrame) == 80 && offsetof(RangeFrame, eye) == 32);
static_assert(sizeof(RangePush) == 40);
#endif

LUCIOLE_RECORDS_END

#endif
