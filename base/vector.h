// SPDX-License-Identifier: Apache-2.0
// The vectors of the whole house are those of the scalar float equations, so that nothing is converted at a door.
#pragma once
#include "equations/cpp/float_types.h"

namespace luciole {
using Vec2 = f32::real2;
using Vec3 = f32::real3;
using Vec4 = f32::real4;
}  // namespace luciole
