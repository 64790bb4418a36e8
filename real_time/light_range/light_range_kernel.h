// SPDX-License-Identifier: Apache-2.0
// Per light: this frame's random number, what the shading kernels read, and the prepared bound. One light per lane.
#pragma once
#include <cstdint>

#include "real_time/light_range/reaching_lights.h"
#include "real_time/settings.h"

namespace luciole {

// Same for all lights of a frame.
struct RangeParameters {
  float exposure_over_delta;  // E / delta
  std::uint32_t seed, frame;
  float constant_xi;  // clamped and infinite ranges; negative: every light draws its own
  bool stratified;    // stratified over the lights' order instead of independent
  std::uint32_t stratum_shift;
  bool disc;  // near field
  BoundingVolume bounds;
  bool paper_rows;                            // prepare bounds for the paper's tile test
  float eye[3], right[3], up[3], forward[3];  // view frame
};

// Plain pointers to the planes of VirtualPointLights and ManyLights.
struct VplPlanes {
  const float *position[3], *normal[3], *geometric_normal[3], *incident[3], *flux[3], *diffuse_albedo[3], *f0[3];
  const float *f90, *ggx_alpha, *area;
  const std::uint32_t* key;
};
struct ManyPlanes {
  const float *position[3], *axis[3], *intensity[3];
  const float *scale, *offset, *two_sided, *squared, *area;
  const std::uint32_t* key;
};

// Up to 16 neighbouring entries of a subset.
struct SubsetPiece {
  const std::uint32_t* lights;    // their indices in the planes
  std::uint32_t count;            // 1 ... 16; entries beyond get a bound that reaches nothing
  std::uint32_t subset, subsets;  // which of n^2
};

// Declares, in the namespace of one instruction set, what fills the entries of a piece.
#define LUCIOLE_DECLARE_RANGE_KERNELS(isa)                                                                 \
  namespace luciole::isa {                                                                                 \
  void reach_diffuse(const VplPlanes& lights, const RangeParameters& parameters, const SubsetPiece& piece, \
                     DiffuseEmitter* emitters, BoundBlock& bounds);                                        \
  void reach_glossy(const VplPlanes& lights, const RangeParameters& parameters, const SubsetPiece& piece,  \
                    GlossyEmitter* emitters, BoundBlock& bounds);                                          \
  void reach_many(const ManyPlanes& lights, const RangeParameters& parameters, const SubsetPiece& piece,   \
                  ManyEmitter* emitters, BoundBlock& bounds);                                              \
  }
}  // namespace luciole
LUCIOLE_DECLARE_RANGE_KERNELS(avx512)
LUCIOLE_DECLARE_RANGE_KERNELS(avx2)
LUCIOLE_DECLARE_RANGE_KERNELS(baseline)
#undef LUCIOLE_DECLARE_RANGE_KERNELS
