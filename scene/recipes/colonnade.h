// SPDX-License-Identifier: Apache-2.0
// What `lights` and `lamps` share: a hall of columns with blocks and a ball to catch light and cast shadows.
#pragma once
#include "scene/recipes/mesh_builder.h"

namespace luciole::workshop {

// The inside of a box x in [-width/2, width/2], y in [0, height], z in [-length/2, length/2].
struct HallSize {
  float width = 12, height = 5, length = 18;  // [m]
};

// Adds floor, walls, ceiling, two rows of columns, blocks, a metal ball and a metal jar. About 20,000 triangles.
void add_colonnade(Scene& scene, const HallSize& size);

}  // namespace luciole::workshop
