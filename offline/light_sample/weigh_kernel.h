// SPDX-License-Identifier: Apache-2.0
// How much each of many lights is worth to one surface point: sixteen lights at a time, compiled for each instruction
// set.
#pragma once
#include <cstdint>

#include "offline/light_set/light_set.h"

namespace luciole {

// A surface point that looks for light, in grey. Plain floats: all instruction sets read it.
struct Receiver {
  float position[3];          // [m]
  float shading_normal[3];    // unit, on the viewer's side
  float geometric_normal[3];  // unit, on the viewer's side
  float to_eye[3];            // unit
  float diffuse;              // albedo, mean of R, G, B   [1]
  float f0, f90;              // f0: mean of R, G, B       [1]
  float ggx_alpha;
};

// What weights depend on, of lights that several receivers share: one row per value, 64-byte aligned, a whole number of
// 16 lights long.
struct LightRowsView {
  enum Row { kX, kY, kZ, kRadius, kAxisX, kAxisY, kAxisZ, kIntensity, kScale, kOffset, kTwoSided, kLamp, kXi, kRows };
  const float* row[kRows] = {};
  std::uint32_t count = 0;
};

enum class Weight : std::uint8_t {
  // Reflected light over the probability to overlap:  R max(I s / l^2, radiance_floor).  With p = I s / (floor l^2) < 1
  // this is R floor: lights that overlap by chance are all alike, but for the surface. With a floor of 0: no culling.
  reflected,
  // As printed, with cos at the receiver: fall-off, flux and the two cosines.                          [TH16] Eq. 9
  printed
};

#define LUCIOLE_DECLARE_WEIGH_KERNEL(isa)                                                                            \
  namespace isa {                                                                                                    \
  /* weights[k]: of light k of the rows, 64-byte aligned, a whole number of 16 long. 0 where no part of the light */ \
  /* is in reach (I s / l^2 > xi floor) or above the surface; positive wherever any part of it can shine on the */   \
  /* surface: else the estimate would miss it. */                                                                    \
  void weigh_lights(const LightRowsView& lights, const Receiver& receiver, Weight weight, float radiance_floor,      \
                    float* weights);                                                                                 \
  }
LUCIOLE_DECLARE_WEIGH_KERNEL(avx512)
LUCIOLE_DECLARE_WEIGH_KERNEL(avx2)
LUCIOLE_DECLARE_WEIGH_KERNEL(baseline)
#undef LUCIOLE_DECLARE_WEIGH_KERNEL

}  // namespace luciole
