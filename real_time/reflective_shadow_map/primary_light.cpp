// SPDX-License-Identifier: Apache-2.0
#include "real_time/reflective_shadow_map/primary_light.h"

#include <algorithm>
#include <numbers>

#include "real_time/reflective_shadow_map/basis.h"

namespace luciole {
namespace {

// Rec. 709 luminance of a linear colour.
float luminance(Vec3 rgb) { return dot(rgb, Vec3(0.2126f, 0.7152f, 0.0722f)); }

bool equal(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

bool equal(const PunctualLight& a, const PunctualLight& b) {
  return a.kind == b.kind && equal(a.position, b.position) && equal(a.direction, b.direction) &&
         equal(a.intensity, b.intensity) && a.cos_inner == b.cos_inner && a.cos_outer == b.cos_outer;
}

}  // namespace

std::vector<std::uint32_t> other_lights(const Scene& scene, const PrimaryLights& primaries) {
  std::vector<std::uint32_t> others;
  std::vector<bool> matched(primaries.size(), false);
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    std::size_t p = 0;
    while (p < primaries.size() && (matched[p] || !equal(primaries[p], scene.lights[i]))) ++p;
    if (p < primaries.size()) {
      matched[p] = true;
    } else {
      others.push_back(i);
    }
  }
  return others;
}

float power(const PunctualLight& light, const Bounds& scene_bounds) {
  constexpr float kPi = std::numbers::pi_v<float>;
  switch (light.kind) {
    case PunctualLight::Kind::point:
      return luminance(light.intensity) * (4 * kPi);
    case PunctualLight::Kind::spot: {
      // The full cone, and a third of the ramp: its squared cosine ramp integrated over the cosine.
      const float ramp = ramp_width(light);
      const float full = std::max(1 - (light.cos_outer + ramp), 0.0f);
      return luminance(light.intensity) * (2 * kPi) * (full + ramp / 3);
    }
    case PunctualLight::Kind::directional: {
      const SunRectangle rectangle = sun_rectangle(light.direction, scene_bounds);
      return luminance(light.intensity) * rectangle.width * rectangle.height;
    }
  }
  return 0;
}

SunRectangle sun_rectangle(Vec3 direction, const Bounds& scene_bounds) {
  const Basis frame = frame_around(direction);
  SunRectangle rectangle;
  rectangle.right = frame.right, rectangle.up = frame.up;
  if (!(scene_bounds.low.x <= scene_bounds.high.x)) return rectangle;
  Bounds local;  // along right, up and direction
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1) != 0 ? scene_bounds.high.x : scene_bounds.low.x,
                 (corner & 2) != 0 ? scene_bounds.high.y : scene_bounds.low.y,
                 (corner & 4) != 0 ? scene_bounds.high.z : scene_bounds.low.z);
    local.grow(Vec3(dot(p, frame.right), dot(p, frame.up), dot(p, frame.axis)));
  }
  rectangle.width = local.high.x - local.low.x, rectangle.height = local.high.y - local.low.y;
  // A hundredth of the scene in front of it, so that no ray starts on a surface.
  const float front = local.low.z - 0.01f * scene_bounds.diagonal();
  rectangle.corner = frame.world(Vec3(local.low.x, local.low.y, front));
  return rectangle;
}

}  // namespace luciole
