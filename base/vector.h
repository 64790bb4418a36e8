// SPDX-License-Identifier: Apache-2.0
// The vectors of the whole house are those of the scalar float equations, so that nothing is converted at a door.
#pragma once
#include "equations/cpp/float_types.h"

namespace luciole {
using Vec2 = f32::real2;
using Vec3 = f32::real3;
using Vec4 = f32::real4;

// Of a colour.
inline float channel_mean(Vec3 rgb) { return (rgb.x + rgb.y + rgb.z) * (1.0f / 3.0f); }
inline bool is_black(Vec3 rgb) { return !(rgb.x > 0 || rgb.y > 0 || rgb.z > 0); }
}  // namespace luciole
