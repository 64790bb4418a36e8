// SPDX-License-Identifier: Apache-2.0
// Right-handed frames around a direction.
#pragma once
#include "base/vector.h"

namespace luciole {

// Two unit vectors perpendicular to a unit vector and to each other; right-handed: cross(right, up) = axis.
struct Basis {
  Vec3 right, up, axis;
  Vec3 world(Vec3 local) const { return right * local.x + up * local.y + axis * local.z; }
};
Basis frame_around(Vec3 axis);

}  // namespace luciole
