// SPDX-License-Identifier: Apache-2.0
#include "real_time/direct_light/direct_sources.h"

namespace luciole {
namespace {

void copy(Vec3 from, float (&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

DirectSource source_of(const PunctualLight& light) {
  DirectSource source{};
  source.sun = light.kind == PunctualLight::Kind::directional;
  copy(light.position, source.position);
  copy(light.direction, source.direction);
  copy(light.intensity, source.colour);
  source.offset = 1;
  if (light.kind == PunctualLight::Kind::spot) {
    source.scale = 1 / ramp_width(light);
    source.offset = -light.cos_outer * source.scale;
  }
  return source;
}

}  // namespace

PrimaryLights direct_lights(const Scene& scene, const PrimaryLights& primaries) {
  PrimaryLights lights = primaries;
  for (const std::uint32_t index : other_lights(scene, primaries)) {
    const PunctualLight& light = scene.lights[index];
    if (light.kind == PunctualLight::Kind::directional) lights.push_back(light);
  }
  return lights;
}

std::vector<DirectSource> direct_sources(const PrimaryLights& lights) {
  std::vector<DirectSource> sources;
  for (const PunctualLight& light : lights) sources.push_back(source_of(light));
  return sources;
}

}  // namespace luciole
