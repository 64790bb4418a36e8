// SPDX-License-Identifier: Apache-2.0
// What culling and shading read of a light, shared with shaders. Plain floats, so that the file for each instruction
// set can read them. `probability_scale` is E / delta times the intensity's constant part, largest channel: p =
// min(probability_scale * g(w_o) / (l^2 + disc), 1).
#ifndef LUCIOLE_EMITTERS_H
#define LUCIOLE_EMITTERS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// Broadcast to all pixels of a group.
struct LUCIOLE_ALIGNED(32) DiffuseEmitter {
  float position[3], normal[3], geometric_normal[3];
  float incident[3];   // w_i
  float intensity[3];  // flux * diffuse albedo; times (1 - F) cos / pi it is the radiant intensity [W/sr]
  float probability_scale;
  float xi;           // this frame's random number; 0: always accepted
  float disc;         // A / pi of the near field [m^2]
  float f0_max, f90;  // Fresnel loss (KHR_materials_specular)
  float unused[4];
};

struct LUCIOLE_ALIGNED(32) GlossyEmitter {
  float position[3], normal[3], geometric_normal[3];
  float incident[3];
  float flux[3];            // Phi [W]
  float probability_scale;  // E / delta: the largest channel of flux * F varies with direction
  float xi;
  float disc;
  float f0[3];
  float f90;
  float alpha_sq, cos_incident, masking;  // FixedDirectionBrdf
  float unused[7];
};

struct LUCIOLE_ALIGNED(32) ManyEmitter {
  float position[3], axis[3];
  float intensity[3];
  float probability_scale;
  float xi;
  float disc;
  float scale, offset, two_sided, squared;  // many_lights.h
};

#if !defined(__cplusplus)
#define LUCIOLE_BOUND_ROW(name, place) const int name = place;
#include "real_time/light_range/bound_rows.inc"
#undef LUCIOLE_BOUND_ROW
#endif

// What the culling kernels read of 16 lights, one per lane: the prepared ellipsoid of equations/tile_test.h, in view
// space (right, up, forward). The first four rows reject most lights; the others are read only where they do not.
struct LUCIOLE_ALIGNED(64) BoundBlock {
#if defined(__cplusplus)
#define LUCIOLE_BOUND_ROW(name, place) name = place,
  enum Row : int {
#include "real_time/light_range/bound_rows.inc"
  };
#undef LUCIOLE_BOUND_ROW
#endif
  float row[kRows][16];
};

#if defined(__cplusplus)
static_assert(sizeof(DiffuseEmitter) == 96 && offsetof(DiffuseEmitter, unused) == 80);
static_assert(sizeof(GlossyEmitter) == 128 && offsetof(GlossyEmitter, unused) == 100);
static_assert(sizeof(ManyEmitter) == 64 && offsetof(ManyEmitter, squared) == 60);
static_assert(sizeof(BoundBlock) == BoundBlock::kRows * 64);
#endif

LUCIOLE_RECORDS_END

#endif
