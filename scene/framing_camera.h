// SPDX-License-Identifier: Apache-2.0
// A camera for scenes without one.
#pragma once
#include "scene/scene.h"

namespace luciole {

// Rooms (scene/room_or_object.h) are seen from inside: from a third of their height, near one end of the longer
// horizontal side, along it. Everything else is seen whole, from outside and a little above, from the side where it is
// open.
Camera framing_camera(const Scene& scene);

}  // namespace luciole
