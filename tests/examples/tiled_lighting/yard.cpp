// SPDX-License-Identifier: Apache-2.0
#include "yard.h"

#include <equations/cpp/float.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace {

using luciole::f32::real3;

constexpr float kYard = 30;  // half its side [m]

struct Crate {
  real3 low, high;
};
const Crate kCrates[] = {{real3(-12, 0, -6), real3(-8, 3, -2)},
                         {real3(-3, 0, -14), real3(4, 5, -10)},
                         {real3(6, 0, 2), real3(9, 2, 5)},
                         {real3(-6, 0, 6), real3(-4, 1, 9)},
                         {real3(12, 0, -12), real3(16, 4, -4)}};

float component(real3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Hit {
  float distance = 1e30f;
  real3 normal;
};

// Slab test; the normal is that of the side through which the ray enters.
Hit hit_crate(const Crate& crate, real3 origin, real3 direction) {
  Hit hit{0, real3(0, 0, 0)};
  float leave = 1e30f;
  for (int axis = 0; axis < 3; ++axis) {
    const float along = component(direction, axis), start = component(origin, axis);
    float near = (component(crate.low, axis) - start) / along, far = (component(crate.high, axis) - start) / along;
    if (near > far) std::swap(near, far);
    if (near > hit.distance) {
      const float side = along > 0 ? -1.0f : 1.0f;
      hit = {near, real3(axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0)};
    }
    leave = std::min(leave, far);
  }
  return hit.distance > 0 && hit.distance < leave ? hit : Hit{};
}

Surface see(real3 origin, real3 direction) {
  Hit nearest;
  if (direction.y < 0) nearest = {-origin.y / direction.y, real3(0, 1, 0)};
  const real3 ground = origin + direction * nearest.distance;
  if (std::abs(ground.x) > kYard || std::abs(ground.z) > kYard) nearest = Hit{};
  float albedo = 0.5f;
  for (const Crate& crate : kCrates) {
    const Hit hit = hit_crate(crate, origin, direction);
    if (hit.distance < nearest.distance) nearest = hit, albedo = 0.8f;
  }
  if (nearest.distance > 1e29f) return {};
  const real3 point = origin + direction * nearest.distance;
  return {{point.x, point.y, point.z}, albedo, {nearest.normal.x, nearest.normal.y, nearest.normal.z}, 0};
}

}  // namespace

std::vector<Surface> see_yard(std::uint32_t width, std::uint32_t height) {
  const real3 eye(0, 9, 26), forward = normalize(real3(0, -0.35f, -1)), right(1, 0, 0), up = cross(right, forward);
  std::vector<Surface> surfaces;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const float across = 1.2f * ((float(x) + 0.5f) / float(width) - 0.5f);
      const float upwards = 1.2f * (0.5f - (float(y) + 0.5f) / float(height));
      surfaces.push_back(see(eye, normalize(forward + right * across + up * upwards)));
    }
  }
  return surfaces;
}

std::vector<Light> hang_lamps(std::uint32_t count, float max_error) {
  std::mt19937 random(7);
  const auto between = [&](float low, float high) { return low + (high - low) * float(random() >> 8) / 16777216.0f; };
  std::vector<Light> lights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const real3 position(between(-kYard, kYard), between(0.3f, 6), between(-kYard, kYard));
    const float power = 0.02f * std::exp(between(0, 3)) * 4096.0f / float(count);
    const real3 intensity = real3(1, between(0.4f, 0.9f), between(0.1f, 0.8f)) * power;
    const float floor = luciole::f32::falloff_floor_of_error(max_error, 1, intensity.x);
    lights.push_back({{position.x, position.y, position.z}, 0, {intensity.x, intensity.y, intensity.z}, floor});
  }
  return lights;
}
