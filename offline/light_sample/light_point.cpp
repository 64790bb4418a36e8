// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/light_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "offline/light_sample/spherical_triangle.h"
#include "scene/emissive_triangles.h"
#include "scene/punctual_light.h"
#include "scene/surface.h"

namespace luciole {
namespace {

constexpr float kFinestLevel = -20;  // of detail
// From this squared ratio of a light's radius to its distance on, points are uniform in solid angle instead of area: at
// a twentieth of the distance the density per area is still the same to a few percent.
constexpr float kLargeRatioSq = 1.0f / 400;

struct Corners {
  Vec3 a, b, c;
  Corners(const Scene& scene, const LightRecord& light) {
    const Mesh& mesh = scene.meshes[light.mesh];
    const std::uint32_t* index = &mesh.indices[std::size_t(light.triangle) * 3];
    a = mesh.positions[index[0]], b = mesh.positions[index[1]], c = mesh.positions[index[2]];
  }
  float doubled_area() const { return length(cross(b - a, c - a)); }
};

SphericalTriangle::Vector unit_towards(Vec3 to, Vec3 from) {
  const SphericalTriangle::Vector d(double(to.x) - from.x, double(to.y) - from.y, double(to.z) - from.z);
  return f64::normalize(d);
}

SphericalTriangle seen_from(const Corners& t, Vec3 receiver) {
  return {unit_towards(t.a, receiver), unit_towards(t.b, receiver), unit_towards(t.c, receiver)};
}

bool is_large(const LightRecord& light, Vec3 receiver) {
  const Vec3 apart = light.centre() - receiver;
  return light.radius * light.radius > kLargeRatioSq * dot(apart, apart);
}

// Barycentric place of the triangle's point in a direction; the direction meets it but for rounding.
Vec2 barycentric(const Corners& t, Vec3 receiver, Vec3 direction) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, p = cross(direction, ac), from_a = receiver - t.a;
  const float inverse = 1 / dot(ab, p);
  const float u = std::clamp(dot(from_a, p) * inverse, 0.0f, 1.0f);
  const float v = std::clamp(dot(direction, cross(from_a, ab)) * inverse, 0.0f, 1.0f - u);
  return {u, v};
}

// Everything about a point of a triangle but its radiance and pdf; false if it shows its dark side.
bool set_geometry(const LightRecord& light, Vec3 receiver, LightPoint& point) {
  const Vec3 apart = point.position - receiver;
  point.place.distance_sq = dot(apart, apart);
  point.direction = apart * (1 / std::sqrt(std::max(point.place.distance_sq, 1e-30f)));
  const float cosine = -dot(light.axis(), point.direction);
  point.normal = cosine >= 0 ? light.axis() : -light.axis();
  point.place.factor = directional_factor(light, cosine);
  return point.place.factor > 0;
}

float area_pdf(const Corners& corners, const LightPoint& point) {
  return point.place.distance_sq / (0.5f * corners.doubled_area() * point.place.factor);
}

LightPoint lamp_point(const Scene& scene, const LightRecord& light, Vec3 receiver) {
  LightPoint point;
  point.position = light.centre();
  set_geometry(light, receiver, point);
  point.normal = {0, 0, 0};
  point.radiance = intensity_towards(scene.lights[light.mesh], -point.direction) / point.place.distance_sq;
  point.pdf = point.place.factor > 0 ? 1.0f : 0.0f;
  return point;
}

}  // namespace

namespace {

Vec2 uniform_place(Vec2 u) {
  const float root = std::sqrt(u.x);
  return {1 - root, u.y * root};
}

// The point of a triangle at a barycentric place, with its radiance, but without pdf; black if it shows its dark side.
LightPoint triangle_point(const Scene& scene, const LightRecord& light, const Corners& t, Vec3 receiver, Vec2 place) {
  LightPoint point;
  point.position = t.a * (1 - place.x - place.y) + t.b * place.x + t.c * place.y;
  if (!set_geometry(light, receiver, point)) return {};
  const SurfaceHit hit{light.mesh, light.triangle, place.x, place.y};
  const Material& material = scene.materials[scene.meshes[light.mesh].material];
  point.radiance = emission_at(scene, hit, kFinestLevel);
  // Holes shine not; what blends shines as much as it covers.
  if (material.alpha_mode == AlphaMode::mask && !alpha_passes(scene, hit)) point.radiance = {0, 0, 0};
  if (material.alpha_mode == AlphaMode::blend) point.radiance *= surface_alpha(scene, hit);
  return point;
}

}  // namespace

LightPoint uniform_light_point(const Scene& scene, const LightRecord& light, Vec3 receiver, Vec2 u) {
  return triangle_point(scene, light, Corners(scene, light), receiver, uniform_place(u));
}

LightPoint sample_light_point(const Scene& scene, const LightRecord& light, Vec3 receiver, Vec2 u) {
  if (light.lamp > 0) return lamp_point(scene, light, receiver);
  const Corners t(scene, light);
  if (!is_large(light, receiver)) {
    LightPoint point = triangle_point(scene, light, t, receiver, uniform_place(u));
    if (point.place.factor > 0) point.pdf = area_pdf(t, point);
    return point;
  }
  const SphericalTriangle seen = seen_from(t, receiver);
  if (!(seen.solid_angle() > 0)) return {};
  const SphericalTriangle::Vector d = seen.sample(u.x, u.y);
  const Vec3 direction(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
  LightPoint point = triangle_point(scene, light, t, receiver, barycentric(t, receiver, direction));
  if (point.place.factor > 0) point.pdf = static_cast<float>(1 / seen.solid_angle());
  return point;
}

LightPoint light_point_hit(const Scene& scene, const LightRecord& light, Vec3 receiver, Vec3 direction, Vec3 position) {
  LightPoint point;
  point.position = position;
  if (!set_geometry(light, receiver, point)) return {};
  point.direction = direction;
  const Corners t(scene, light);
  point.pdf = is_large(light, receiver) ? static_cast<float>(1 / std::max(seen_from(t, receiver).solid_angle(), 1e-30))
                                        : area_pdf(t, point);
  return point;
}

}  // namespace luciole
