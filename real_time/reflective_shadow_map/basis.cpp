// SPDX-License-Identifier: Apache-2.0
#include "real_time/reflective_shadow_map/basis.h"

namespace luciole {

Basis frame_around(Vec3 axis) {
  // From the world axis that is farthest from this one, so that the cross product is never short.
  const Vec3 size = abs(axis);
  Vec3 far_axis(0, 0, 1);
  if (size.x <= size.y && size.x <= size.z) {
    far_axis = Vec3(1, 0, 0);
  } else if (size.y <= size.z) {
    far_axis = Vec3(0, 1, 0);
  }
  const Vec3 right = normalize(cross(far_axis, axis));
  return {right, cross(axis, right), axis};
}

}  // namespace luciole
