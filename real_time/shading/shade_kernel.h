// SPDX-License-Identifier: Apache-2.0
// The shading kernels of each instruction set.
#pragma once
#include <cstdint>

#include "real_time/light_range/reaching_lights.h"
#include "real_time/shading/pixel_group.h"

namespace luciole {

// Lights to be added to a group: `count` ascending indices into a subset's emitters.
template <class Emitter>
struct LightList {
  const Emitter* emitters;
  const std::uint32_t* index;
  std::uint32_t count;
  const std::uint16_t* visible;  // per entry, the lanes that its shadow rays reach; null: all
};

// Declares, in the namespace of one instruction set:
//   shade_group     the sum over a list, overwriting `out`. divide_by_p: weight by 1/p (stochastic ranges), or by 1
//                   (clamped and infinite ranges)
//   accepted_lanes  per entry of a list, the lanes with p > xi
#define LUCIOLE_DECLARE_SHADE_KERNELS_OF(Emitter)                                                                  \
  void shade_group(const PixelGroup& group, const LightList<Emitter>& list, bool divide_by_p, GroupRadiance& out); \
  void accepted_lanes(const PixelGroup& group, const LightList<Emitter>& list, std::uint16_t* lanes);
#define LUCIOLE_DECLARE_SHADE_KERNELS(isa)         \
  namespace luciole::isa {                         \
  LUCIOLE_DECLARE_SHADE_KERNELS_OF(DiffuseEmitter) \
  LUCIOLE_DECLARE_SHADE_KERNELS_OF(GlossyEmitter)  \
  LUCIOLE_DECLARE_SHADE_KERNELS_OF(ManyEmitter)    \
  }
}  // namespace luciole
LUCIOLE_DECLARE_SHADE_KERNELS(avx512)
LUCIOLE_DECLARE_SHADE_KERNELS(avx2)
LUCIOLE_DECLARE_SHADE_KERNELS(baseline)
#undef LUCIOLE_DECLARE_SHADE_KERNELS
#undef LUCIOLE_DECLARE_SHADE_KERNELS_OF
