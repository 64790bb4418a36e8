// SPDX-License-Identifier: Apache-2.0
// Door: the lights that get a reflective shadow map, virtual point lights and ray-traced shadows.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/punctual_light.h"
#include "scene/scene.h"

namespace luciole {

// A punctual light, chosen by the shot ([[primary]]) or among the file's strongest.
using PrimaryLights = std::vector<PunctualLight>;

// The scene's lights that are not primary, as indices in Scene::lights. Lights have no identity but their values: each
// primary light takes away one that is equal to it, if there is one.
std::vector<std::uint32_t> other_lights(const Scene&, const PrimaryLights&);

// Flux of a light into the scene [W], luminance of its colour: what VPLs are shared by. A sun's is its irradiance
// times the area of the rectangle round the scene's bounds, seen along its direction.
float power(const PunctualLight&, const Bounds& scene_bounds);

// The rectangle round the scene's bounds, perpendicular to a sun's direction, through which its light enters.
struct SunRectangle {
  Vec3 corner;                  // [m], in front of the whole scene
  Vec3 right, up;               // unit edges
  float width = 0, height = 0;  // [m]; 0 for an empty scene
};
SunRectangle sun_rectangle(Vec3 direction, const Bounds& scene_bounds);

}  // namespace luciole
