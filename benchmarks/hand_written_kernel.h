// SPDX-License-Identifier: Apache-2.0
// The shading kernel once more, written by hand with AVX-512 intrinsics: the measure of what the compiler makes of the
// portable one (real_time/shading/shade_kernel.h). Same arithmetic, same results within rounding.
#pragma once
#include "real_time/shading/shade_kernel.h"

namespace luciole::hand_written {

// How the loop over lights is built.
enum class Loop {
  early_out,    // leaves a light that no pixel accepts, as the portable kernel
  branch_free,  // computes everything and masks the sums
  two_lights,   // tests two lights before either is shaded
  exact         // early_out, with division and square root instead of 14 bits and a Newton step
};

// Sums with weight 1/p, as shade_group(group, list, true, out); visibility is not asked for.
void shade_group(Loop loop, const PixelGroup& group, const LightList<DiffuseEmitter>& list, GroupRadiance& out);
void shade_group(Loop loop, const PixelGroup& group, const LightList<GlossyEmitter>& list, GroupRadiance& out);

}  // namespace luciole::hand_written
