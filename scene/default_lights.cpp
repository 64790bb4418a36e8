// SPDX-License-Identifier: Apache-2.0
#include "scene/default_lights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/emissive_triangles.h"
#include "scene/room_or_object.h"

namespace luciole {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kSunIrradiance = 3;   // [W/m^2]
constexpr float kSkyRadiance = 0.3f;  // [W/(m^2 sr)]
// What the light of its triangles has to bring on average to the bounds of a scene that is seen by it [W/m^2]. Of an
// object's lamps little falls on itself: a tenth of the sun. A room keeps its light and the sun may not come in: enough
// that there is something to expose for.
constexpr float kLeastOnObject = 0.1f * kSunIrradiance, kLeastInRoom = 0.01f;

// Flux of all emissive triangles, mean of the channels, by area of the bounds [W/m^2].
float own_light(const Scene& scene) {
  double flux = 0;
  for (const EmissiveTriangle& triangle : emissive_triangles(scene)) {
    const Vec3 by_channel = power(triangle);
    flux += static_cast<double>((by_channel.x + by_channel.y + by_channel.z) / 3);
  }
  if (!(flux > 0)) return 0;
  const Bounds bounds = scene.bounds();
  const Vec3 size = bounds.high - bounds.low;
  return static_cast<float>(flux) / (2 * (size.x * size.y + size.y * size.z + size.z * size.x));
}

}  // namespace

std::string add_default_lights(Scene& scene) {
  const Vec3 sky = scene.environment.radiance;
  if (!scene.lights.empty() || sky.x > 0 || sky.y > 0 || sky.z > 0) return "";
  const float own = own_light(scene);
  if (own >= kLeastOnObject || (own >= kLeastInRoom && is_room(scene))) return "";
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::directional;
  sun.name = "default sun";
  sun.direction = normalize(Vec3(-0.35f, -1.0f, -0.28f));
  sun.intensity = {kSunIrradiance, kSunIrradiance, kSunIrradiance};
  scene.lights.push_back(sun);
  scene.environment.radiance = {kSkyRadiance, kSkyRadiance, kSkyRadiance};
  return std::string(own > 0 ? "The scene's own light does not show it" : "The scene has no light") +
         ": it gets a sun of 3 W/m^2 and a constant sky of 0.3 W/(m^2 sr).";
}

float power(const PunctualLight& light, float scene_radius) {
  const float mean = (light.intensity.x + light.intensity.y + light.intensity.z) / 3;
  switch (light.kind) {
    case PunctualLight::Kind::point:
      return 4 * kPi * mean;
    case PunctualLight::Kind::directional:
      return kPi * scene_radius * scene_radius * mean;
    case PunctualLight::Kind::spot:
      break;
  }
  // The ramp is the square of a line in the cosine: its mean over the ring between the cones is a third.
  return 2 * kPi * mean * ((1 - light.cos_inner) + (light.cos_inner - light.cos_outer) / 3);
}

std::vector<std::size_t> strongest_lights(const Scene& scene, std::size_t count) {
  const Bounds bounds = scene.bounds();
  const float radius = bounds.low.x <= bounds.high.x ? 0.5f * bounds.diagonal() : 0.0f;
  std::vector<std::size_t> order(scene.lights.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return power(scene.lights[a], radius) > power(scene.lights[b], radius);
  });
  order.resize(std::min(order.size(), count));
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace luciole
