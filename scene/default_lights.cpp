// SPDX-License-Identifier: Apache-2.0
#include "scene/default_lights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/emissive_triangles.h"

namespace luciole {
namespace {

constexpr float kPi = 3.14159265f;

}  // namespace

std::string add_default_lights(Scene& scene) {
  const Vec3 sky = scene.environment.radiance;
  if (!scene.lights.empty() || sky.x > 0 || sky.y > 0 || sky.z > 0) return "";
  if (!emissive_triangles(scene).empty()) return "";
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::directional;
  sun.name = "default sun";
  sun.direction = normalize(Vec3(-0.35f, -1.0f, -0.28f));
  sun.intensity = {3, 3, 3};
  scene.lights.push_back(sun);
  scene.environment.radiance = {0.3f, 0.3f, 0.3f};
  return "The scene has no light: it gets a sun of 3 W/m^2 and a constant sky of 0.3 W/(m^2 sr).";
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
