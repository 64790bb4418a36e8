// SPDX-License-Identifier: Apache-2.0
// A camera for scenes without one.
#pragma once
#include "scene/scene.h"

namespace luciole {

// Rooms (most of what one sees from their middle are fronts of surfaces) are seen from inside: from a third of their
// height, near one end of the longer horizontal side, along it. Objects are seen whole, from outside and a little
// above.
Camera framing_camera(const Scene& scene);

}  // namespace luciole
