// SPDX-License-Identifier: Apache-2.0
// Which punctual lights of a scene count as primary, and what a scene gets that has no light at all.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace luciole {

// Gives a scene without any light (no punctual light, no emissive triangle, no environment) a sun of 3 W/m^2 from 24
// degrees off the zenith and a sky of constant 0.3 W/(m^2 sr). Returns the sentence for the user; empty: nothing done.
std::string add_default_lights(Scene& scene);

// The indices of the `count` lights of most power, in file order: the primary lights of shots that list none. A
// directional light counts with what falls through the circle that holds the scene.
std::vector<std::size_t> strongest_lights(const Scene& scene, std::size_t count = 4);

// Total flux of a light [W], mean of the channels.
//   scene_radius  of the sphere round the scene [m], for directional lights
float power(const PunctualLight& light, float scene_radius);

}  // namespace luciole
