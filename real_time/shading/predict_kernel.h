// SPDX-License-Identifier: Apache-2.0
// What the roulette must give: per pixel, the exact sum over all lights, and the exact variance and count of one frame.
#pragma once
#include <cstdint>

#include "real_time/light_range/reaching_lights.h"
#include "real_time/shading/pixel_group.h"

namespace luciole {

// Lights of one subset, entry i of `diffuse` and of `glossy` being two lobes of one virtual point light. Of lobes that
// are left out (Lobes) there are none: null.
struct SubsetLights {
  const DiffuseEmitter* diffuse;
  const GlossyEmitter* glossy;
  std::uint32_t vpl_count;
  const ManyEmitter* many;
  std::uint32_t many_count;
};

struct alignas(64) GroupPrediction {
  float sum[3][kGroupPixels];       // radiance by all lights of the subset, not weighted by n^2 [W/(m^2 sr)]
  float variance[3][kGroupPixels];  // of the roulette: sum of L^2 (1/p - 1) and of the coupling of the two lobes
  float accepted[kGroupPixels];     // sum of p
};

// Declares, in the namespace of one instruction set. diffuse_albedo: of the group's pixels.
#define LUCIOLE_DECLARE_PREDICT_KERNEL(isa)                                                   \
  namespace luciole::isa {                                                                    \
  void predict_group(const PixelGroup& group, const float (&diffuse_albedo)[3][kGroupPixels], \
                     const SubsetLights& lights, GroupPrediction& out);                       \
  }
}  // namespace luciole
LUCIOLE_DECLARE_PREDICT_KERNEL(avx512)
LUCIOLE_DECLARE_PREDICT_KERNEL(avx2)
LUCIOLE_DECLARE_PREDICT_KERNEL(baseline)
#undef LUCIOLE_DECLARE_PREDICT_KERNEL
