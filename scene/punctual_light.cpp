// SPDX-License-Identifier: Apache-2.0
#include "scene/punctual_light.h"

#include <algorithm>

namespace luciole {

float ramp_width(const PunctualLight& spot) {
  return std::max({spot.cos_inner - spot.cos_outer, 1e-6f * (1 - spot.cos_outer), 1e-12f});
}

Vec3 intensity_towards(const PunctualLight& light, Vec3 direction) {
  if (light.kind == PunctualLight::Kind::point) return light.intensity;
  const float t = std::clamp((dot(direction, light.direction) - light.cos_outer) / ramp_width(light), 0.0f, 1.0f);
  return light.intensity * (t * t);
}

}  // namespace luciole
