// SPDX-License-Identifier: Apache-2.0
// Simple polygons, as OBJ faces are, to triangles.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace luciole {

// Corner numbers, three per triangle, wound as the polygon is. Concave polygons are cut by clipping ears in the plane
// of their mean normal; crossing or flat ones give some triangulation with corners - 2 triangles.
std::vector<std::uint32_t> triangulate(const std::vector<Vec3>& corners);

}  // namespace luciole
