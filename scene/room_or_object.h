// SPDX-License-Identifier: Apache-2.0
// Whether a scene is looked at from inside or from outside.
#pragma once
#include "scene/scene.h"

namespace luciole {

// Where one stands in a room: over the middle of the floor, at a third of the height [m].
Vec3 middle_of_room(const Bounds& bounds);

// A room is closed around its middle, is made to be seen from inside, and one can stand in it:
//   - three quarters of the directions from its middle meet fronts of triangles (a ground with things on it: fewer);
//   - less than half of the light that left its triangles' fronts evenly would leave the scene (a helmet's inside is
//     closed as well, but most of its surface is outside);
//   - it is 1.5 m high, or its surfaces enclose no volume from outside, but from inside, so that outside there are
//     only backs to be seen (a car's cabin is a room to the first two rules).
// False for a scene without triangles.
bool is_room(const Scene& scene);

}  // namespace luciole
