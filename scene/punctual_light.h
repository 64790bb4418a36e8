// SPDX-License-Identifier: Apache-2.0
// How a punctual light shines (KHR_lights_punctual).
#pragma once
#include "scene/scene.h"

namespace luciole {

// Radiant intensity of a point or spot light [W/sr]; glTF's squared ramp between a spot's cones.
//   direction  unit, away from the light
Vec3 intensity_towards(const PunctualLight&, Vec3 direction);

// Width of a spot's ramp, cos_inner - cos_outer, at least a millionth of the cone's 1 - cos_outer: a hard edge divides
// by it too.
float ramp_width(const PunctualLight& spot);

}  // namespace luciole
