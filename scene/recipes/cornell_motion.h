// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "scene/scene.h"

namespace luciole::workshop {

// Eight seconds of motion for the box: the mesh `block`, in its own space, slides and turns; the first light, a spot
// that shines down, swings from side to side; a second camera comes nearer. Leaves the scene at time 0.
void set_in_motion(Scene& scene, std::uint32_t block);

}  // namespace luciole::workshop
