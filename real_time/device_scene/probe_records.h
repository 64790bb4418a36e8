// SPDX-License-Identifier: Apache-2.0
// What the kernels read and write by which tests ask a scene on the device; shared with C++.
#ifndef LUCIOLE_PROBE_RECORDS_H
#define LUCIOLE_PROBE_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

struct RayQuery {
  float origin[3], direction[3];
  float nearest, farthest;
};
struct RayAnswer {
  word_ mesh, triangle;  // kNothing: nothing met
  float u, v, distance;
  word_ complete, turns;
};

struct SurfaceQuery {
  word_ mesh, triangle;
  float u, v;
  float direction[3];  // unit
  float cone_width;
};
// SurfacePoint of scene/surface.h.
struct SurfaceAnswer {
  float position[3], geometric_normal[3], shading_normal[3];
  float diffuse_albedo[3], f0[3], f90, ggx_alpha;
  float emission[3];
  word_ stops_ray;
};

struct ProbePush {
  address_ scene;             // SceneRecord
  address_ queries, answers;  // of one kind
  word_ count;
  word_ any;  // rays: a hit is enough
};

#if defined(__cplusplus)
static_assert(sizeof(RayQuery) == 32 && sizeof(RayAnswer) == 28);
static_assert(sizeof(SurfaceQuery) == 32 && sizeof(SurfaceAnswer) == 84 && sizeof(ProbePush) == 32);
#endif

LUCIOLE_RECORDS_END

#endif
