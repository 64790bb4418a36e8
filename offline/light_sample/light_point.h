// SPDX-License-Identifier: Apache-2.0
// A point on a light, as one receiver sees it.
#pragma once
#include "base/vector.h"
#include "offline/light_sample/light_sampler.h"
#include "offline/light_set/light_set.h"
#include "scene/scene.h"

namespace luciole {

struct LightPoint {
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 0};     // unit, on the side of the receiver; 0 for lamps
  Vec3 direction{0, 0, 1};  // unit, from the receiver
  Vec3 radiance{0, 0, 0};   // of triangles [W/(m^2 sr)]; of lamps what arrives at the receiver [W/m^2]; may be 0
  float pdf = 0;            // per solid angle, given the light [1/sr]; 1 for lamps, which no ray can hit
  LightPlace place{};
};

// Uniform over the triangle's area, or over the solid angle that it fills where that is large. pdf = 0: the receiver
// sees only its back.
//   u  two numbers in (0,1)
LightPoint sample_light_point(const Scene& scene, const LightRecord& light, Vec3 receiver, Vec2 u);

// Uniform over the triangle's area, whatever the receiver; without pdf.
LightPoint uniform_light_point(const Scene& scene, const LightRecord& light, Vec3 receiver, Vec2 u);

// What sample_light_point says of the point of a triangle light that a ray from the receiver has hit; without radiance.
//   direction  unit
LightPoint light_point_hit(const Scene& scene, const LightRecord& light, Vec3 receiver, Vec3 direction, Vec3 position);

}  // namespace luciole
