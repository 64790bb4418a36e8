// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/synthetic_room.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace luciole {
namespace {

struct Surface {
  float distance = kNoSurface;  // along the ray whose depth is 1 [m]
  Vec3 normal{0, 0, 0};
  Vec3 f0{0.04f, 0.04f, 0.04f};
  float ggx_alpha = 0.5f;
  std::uint32_t material = 0xffffffffu;
};

void see(Surface& nearest, const Surface& other) {
  if (other.distance > 0.0f && other.distance < nearest.distance) nearest = other;
}

// dot(normal, x) = offset
Surface plane(Vec3 ray, Vec3 normal, float offset, float ggx_alpha, std::uint32_t material) {
  Surface s;
  s.distance = offset / dot(normal, ray);
  s.normal = normal, s.ggx_alpha = ggx_alpha, s.material = material;
  return s;
}

Surface sphere(Vec3 ray, Vec3 centre, float radius, Vec3 f0, float ggx_alpha, std::uint32_t material) {
  Surface s;
  const float a = dot(ray, ray), b = dot(ray, centre), c = dot(centre, centre) - radius * radius;
  if (b * b < a * c) return s;
  s.distance = (b - std::sqrt(b * b - a * c)) / a;
  s.normal = (ray * s.distance - centre) * (1.0f / radius);
  s.f0 = f0, s.ggx_alpha = ggx_alpha, s.material = material;
  return s;
}

// Floor in squares of two roughnesses with a step of 0.15 m in it, a wall, a back wall with an opening, three spheres.
Surface look(Vec3 ray) {
  Surface nearest;
  Surface step = plane(ray, {0, 1, 0}, -0.85f, 0.3f, 1);
  if (ray.x * step.distance > 0.4f) see(nearest, step);
  Surface floor = plane(ray, {0, 1, 0}, -1.0f, 0.4f, 2);
  const Vec3 at = ray * floor.distance;
  if (std::isfinite(at.x + at.z) &&
      (static_cast<int>(std::floor(at.x * 2)) + static_cast<int>(std::floor(at.z * 2))) % 2 == 0) {
    floor.ggx_alpha = 0.1f, floor.material = 3;
  }
  see(nearest, floor);
  see(nearest, plane(ray, {1, 0, 0}, -2.0f, 0.6f, 4));
  const Surface back = plane(ray, {0, 0, 1}, -8.0f, 0.6f, 5);
  const Vec3 on_back = ray * back.distance;
  if (on_back.x < 1.0f || on_back.y < 0.0f) see(nearest, back);
  see(nearest, sphere(ray, {-0.8f, -0.4f, -3.5f}, 0.6f, {1.0f, 0.77f, 0.34f}, 0.2f, 6));
  see(nearest, sphere(ray, {0.5f, -0.5f, -3.0f}, 0.35f, {0.04f, 0.04f, 0.04f}, 0.3f, 7));
  see(nearest, sphere(ray, {1.4f, -0.2f, -5.0f}, 0.65f, {0.6f, 0.6f, 0.6f}, 0.4f, 8));
  return nearest;
}

struct TwoParts {
  Vec3 diffuse{0, 0, 0}, specular{0, 0, 0};
};

TwoParts light_at(Vec3 x, const Surface& s) {
  static const std::vector<std::pair<Vec3, Vec3>> lights = {{{1.5f, 1.8f, -2.0f}, {3.0f, 2.6f, 2.0f}},
                                                            {{-1.7f, 0.5f, -6.0f}, {1.0f, 1.6f, 3.0f}},
                                                            {{0.2f, 2.5f, -5.0f}, {2.0f, 2.0f, 1.0f}}};
  TwoParts sum;
  const float kept = 1.0f - std::max({s.f0.x, s.f0.y, s.f0.z});
  for (const auto& [position, intensity] : lights) {
    const Vec3 to_light = position - x;
    const Vec3 l = normalize(to_light);
    const float irradiance = std::max(dot(s.normal, l), 0.0f) / (dot(to_light, to_light) + 0.2f);
    const float cos_half = std::max(dot(s.normal, normalize(l + normalize(-x))), 1e-3f);
    const float tan_sq = 1.0f / (cos_half * cos_half) - 1.0f;
    const float a = 1.0f + tan_sq / (s.ggx_alpha * s.ggx_alpha);
    sum.diffuse += intensity * (irradiance * kept + 0.02f * kept);
    sum.specular += intensity * s.f0 * (irradiance / (a * a) + 0.02f);
  }
  return sum;
}

void put(Plane3& planes, std::size_t at, Vec3 v) { planes[0][at] = v.x, planes[1][at] = v.y, planes[2][at] = v.z; }

void put_pixel(SyntheticRoom& room, std::size_t at, Vec3 ray) {
  GeometryBuffer& g = room.geometry;
  const Surface s = look(ray);
  const bool sky = s.material == 0xffffffffu;
  const Vec3 x = sky ? Vec3{0, 0, 0} : ray * s.distance;
  g.depth[at] = sky ? kNoSurface : s.distance;  // rays have depth 1
  put(g.position, at, x);
  put(g.normal, at, s.normal);
  put(g.geometric_normal, at, s.normal);
  put(g.diffuse_albedo, at, {0.5f, 0.5f, 0.5f});
  put(g.f0, at, s.f0);
  put(g.emission, at, {0, 0, 0});
  g.f90[at] = 1.0f, g.ggx_alpha[at] = s.ggx_alpha, g.material[at] = s.material;
  const TwoParts light = sky ? TwoParts{} : light_at(x, s);
  put(room.truth.diffuse, at, light.diffuse);
  put(room.truth.specular, at, light.specular);
}

double relative_error_of(const SyntheticRoom& room, const Plane3& light, const Plane3& truth) {
  double mean = 0, error = 0;
  std::size_t surfaces = 0;
  for (std::size_t at = 0; at < room.geometry.pixel_count(); ++at) {
    if (!(room.geometry.depth[at] < kNoSurface)) continue;
    ++surfaces;
    for (std::size_t c = 0; c < 3; ++c) mean += truth[c][at];
  }
  mean /= 3.0 * double(std::max<std::size_t>(surfaces, 1));
  for (std::size_t at = 0; at < room.geometry.pixel_count(); ++at) {
    if (!(room.geometry.depth[at] < kNoSurface)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const double b = truth[c][at], difference = light[c][at] - b;
      error += difference * difference / (b * b + 0.01 * mean * mean);
    }
  }
  return error / (3.0 * double(std::max<std::size_t>(surfaces, 1)));
}

}  // namespace

void resize_geometry(GeometryBuffer& g, std::uint32_t width, std::uint32_t height) {
  g.width = width, g.height = height;
  const std::size_t pixels = g.pixel_count();
  for (Plane3* planes : {&g.position, &g.normal, &g.geometric_normal, &g.diffuse_albedo, &g.f0, &g.emission}) {
    for (Plane& plane : *planes) plane.resize(pixels);
  }
  for (Plane* plane_of_values : {&g.depth, &g.f90, &g.ggx_alpha}) plane_of_values->resize(pixels);
  g.material.resize(pixels);
}

void resize_light(Radiance& light, std::size_t pixels) {
  for (Plane& plane : light.diffuse) plane.resize(pixels);
  for (Plane& plane : light.specular) plane.resize(pixels);
}

Vec3 pixel_ray(const GeometryBuffer& g, std::uint32_t x, std::uint32_t y) {
  const float footprint = 2.0f * std::tan(0.5f * g.camera.vertical_fov) / static_cast<float>(g.height);
  const float right = (static_cast<float>(x) + g.sub_pixel_x - 0.5f * static_cast<float>(g.width)) * footprint;
  const float down = (static_cast<float>(y) + g.sub_pixel_y - 0.5f * static_cast<float>(g.height)) * footprint;
  return g.camera.forward + g.camera.right * right - g.camera.up * down;
}

SyntheticRoom make_synthetic_room(std::uint32_t width, std::uint32_t height) {
  SyntheticRoom room;
  resize_geometry(room.geometry, width, height);
  resize_light(room.truth, room.geometry.pixel_count());
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x)
      put_pixel(room, std::size_t(y) * width + x, pixel_ray(room.geometry, x, y));
  }
  return room;
}

Radiance interleaved_noise(const SyntheticRoom& room, std::uint32_t interleave, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::exponential_distribution<float> exponential(1.0f);
  const std::uint32_t n = interleave;
  const auto subsets = static_cast<float>(n * n);
  std::vector<float> factors(n * n);
  for (float& factor : factors) factor = 1.0f + std::sqrt(3.0f * 0.25f * (subsets - 1.0f) / 63.0f) * uniform(random);
  float mean = 0;
  for (float factor : factors) mean += factor / subsets;
  Radiance noisy;
  resize_light(noisy, room.geometry.pixel_count());
  const std::uint32_t width = room.geometry.width;
  for (std::size_t at = 0; at < room.geometry.pixel_count(); ++at) {
    const auto x = static_cast<std::uint32_t>(at % width), y = static_cast<std::uint32_t>(at / width);
    const float roulette = 1.0f + std::sqrt(subsets / 64.0f) * (exponential(random) - 1.0f);
    const float factor = factors[(y % n) * n + x % n] / mean * roulette;
    for (std::size_t c = 0; c < 3; ++c) {
      noisy.diffuse[c][at] = room.truth.diffuse[c][at] * factor;
      noisy.specular[c][at] = room.truth.specular[c][at] * factor;
    }
  }
  return noisy;
}

double relative_error(const SyntheticRoom& room, const Radiance& light) {
  return 0.5 * (relative_error_of(room, light.diffuse, room.truth.diffuse) +
                relative_error_of(room, light.specular, room.truth.specular));
}

}  // namespace luciole
