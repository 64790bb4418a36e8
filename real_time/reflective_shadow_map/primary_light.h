// SPDX-License-Identifier: Apache-2.0
// Door: the lights that get a reflective shadow map, virtual point lights and ray-traced shadows.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace luciole {

// A punctual light, chosen by the shot ([[primary]]) or among the file's strongest.
using PrimaryLights = std::vector<PunctualLight>;

// Flux of a light into the scene [W], luminance of its colour: what VPLs are shared by. A sun's is its irradiance
// times the area of the rectangle round the scene's bounds, seen along its direction.
float power(const PunctualLight&, const Bounds& scene_bounds);

}  // namespace luciole
