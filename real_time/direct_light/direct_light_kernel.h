// SPDX-License-Identifier: Apache-2.0
// 16 neighbouring pixels under one light, shadows apart; compiled once per instruction set.
#pragma once
#include <cstddef>
#include <cstdint>

#include "real_time/direct_light/direct_records.h"

namespace luciole {

inline constexpr int kDirectLanes = 16;

// Plain pointers to the planes of GeometryBuffer, and the eye.
struct DirectPixels {
  const float *position[3], *normal[3], *geometric_normal[3], *diffuse_albedo[3], *f0[3], *f90, *ggx_alpha;
  float eye[3];
};

struct alignas(64) DirectReflection {
  float radiance[3][kDirectLanes];  // as if nothing were in the way; 0 where not lit
  std::uint32_t lit;                // bit i: lane i faces the light, is in its cone and reflects
};

// Declares, in the namespace of one instruction set, the kernel for pixels first ... first + 15; first is a multiple
// of 16, and pixels past the last one give values that mean nothing.
#define LUCIOLE_DECLARE_DIRECT_LIGHT(isa)                                                        \
  namespace luciole::isa {                                                                       \
  void reflect_source(const DirectPixels& pixels, std::size_t first, const DirectSource& source, \
                      DirectReflection& out);                                                    \
  }
}  // namespace luciole
LUCIOLE_DECLARE_DIRECT_LIGHT(avx512)
LUCIOLE_DECLARE_DIRECT_LIGHT(avx2)
LUCIOLE_DECLARE_DIRECT_LIGHT(baseline)
#undef LUCIOLE_DECLARE_DIRECT_LIGHT
