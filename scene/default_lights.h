// SPDX-License-Identifier: Apache-2.0
// Which punctual lights of a scene count as primary, and what a scene gets that has no light at all.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace luciole {

// Gives a scene whose own light does not show it a sun of 3 W/m^2 from 24 degrees off the zenith and a sky of constant
// 0.3 W/(m^2 sr): a scene without punctual light and environment whose emissive triangles, spread over the area of its
// bounds, bring less than 0.3 W/m^2 to an object or 0.01 W/m^2 to a room (scene/room_or_object.h). So a helmet with a
// glowing visor and a car with lit lamps are seen, and a room with one lamp keeps its mood. Returns the sentence for
// the user; empty: nothing done.
std::string add_default_lights(Scene& scene);

// The indices of the `count` lights of most power, in file order: the primary lights of shots that list none. A
// directional light counts with what falls through the circle that holds the scene.
std::vector<std::size_t> strongest_lights(const Scene& scene, std::size_t count = 4);

// Total flux of a light [W], mean of the channels.
//   scene_radius  of the sphere round the scene [m], for directional lights
float power(const PunctualLight& light, float scene_radius);

}  // namespace luciole
