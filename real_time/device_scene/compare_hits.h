// SPDX-License-Identifier: Apache-2.0
// For tests: hits on a device against those of Embree and of double precision.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ray_tracing/hierarchy_records.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/device_scene/probe_records.h"
#include "scene/surface.h"

namespace luciole::test {

struct Double3 {
  double x = 0, y = 0, z = 0;
  Double3() = default;
  Double3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  explicit Double3(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
  explicit Double3(const float (&v)[3]) : x(v[0]), y(v[1]), z(v[2]) {}
  Double3 operator-(Double3 o) const { return {x - o.x, y - o.y, z - o.z}; }
  Double3 operator+(Double3 o) const { return {x + o.x, y + o.y, z + o.z}; }
  double dot(Double3 o) const { return x * o.x + y * o.y + z * o.z; }
  Double3 cross(Double3 o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
  double length() const { return std::sqrt(dot(*this)); }
};

// Where a ray meets the plane of a triangle, and how far float may be from that.
struct ExactHit {
  double distance;
  double least_weight;        // of the three barycentric ones; negative: outside
  double distance_tolerance;  // in units of the ray's length
  double weight_tolerance;
  bool is_at_an_edge = false;  // as near as whoever casts or draws does not look

  // It is a matter of rounding whether this is a hit.
  bool is_contested() const { return is_at_an_edge || std::abs(least_weight) <= weight_tolerance; }
};

// To first order in u = 2^-24, with V the largest distance of a corner from the origin, E the longest edge, A twice the
// area and c the cosine between ray and normal.
//   Weights: beside the ray a corner errs 9 u V in each of two numbers (difference, quotient of the slope, product,
//   difference), which moves the areas of two edges by 9 sqrt 2 u V times their length; their products err 3 u E^2.
//   Edges are sqrt 3 E long there, and twice the area is A c at least: (44 V + 9 E) E u / (A c), and E is at most 2 V:
//   62 V E u / (A c). Distance: the corner and the two scalar products move the plane by (1 + 3 + 3) u V; quotient 5
//   (Vulkan allows that) and the position in the plane 1; the normal errs 3 u E^2 of A, and the hit is at most E from
//   the corner.
inline ExactHit exact_hit(const Scene& scene, const RayQuery& ray, std::uint32_t mesh_index, std::uint32_t triangle) {
  constexpr double kU = 0x1p-24;
  const Mesh& mesh = scene.meshes.at(mesh_index);
  const std::uint32_t* index = &mesh.indices.at(std::size_t(triangle) * 3);
  const Double3 origin(ray.origin), d(ray.direction);
  const Double3 a = Double3(mesh.positions[index[0]]) - origin, b = Double3(mesh.positions[index[1]]) - origin,
                c = Double3(mesh.positions[index[2]]) - origin;
  const Double3 normal = (b - a).cross(c - a);
  const double volumes[3] = {d.dot(c.cross(b)), d.dot(a.cross(c)), d.dot(b.cross(a))};
  const double sum = volumes[0] + volumes[1] + volumes[2];
  const double far = std::max({a.length(), b.length(), c.length()});
  const double edge = std::max({(b - a).length(), (c - b).length(), (a - c).length()});
  const double area = normal.length(), approach = std::abs(d.dot(normal)) / area;  // |d| c
  ExactHit hit;
  hit.distance = a.dot(normal) / d.dot(normal);
  hit.least_weight = std::min({volumes[0] / sum, volumes[1] / sum, volumes[2] / sum});
  hit.weight_tolerance = 62 * kU * far * edge * d.length() / (area * approach);
  hit.distance_tolerance = kU * (13 * far + 3 * edge * edge * edge / area) / approach;
  return hit;
}

// Embree's answers, in the same form.
inline std::vector<RayAnswer> in_embree(const RayScene& scene, const std::vector<RayQuery>& rays, bool any = false) {
  std::vector<RayAnswer> answers(rays.size());
  for (std::size_t first = 0; first < rays.size(); first += kPacketRays) {
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) {
      const RayQuery& ray = rays[std::min(first + static_cast<std::size_t>(lane), rays.size() - 1)];
      packet.set(lane, Vec3(ray.origin[0], ray.origin[1], ray.origin[2]),
                 Vec3(ray.direction[0], ray.direction[1], ray.direction[2]), ray.nearest, ray.farthest);
    }
    const HitPacket hits = scene.intersect(packet, Coherence::incoherent);
    const std::uint32_t occluded = any ? scene.occluded(packet, Coherence::incoherent) : 0;
    for (std::size_t lane = 0; lane < std::min<std::size_t>(kPacketRays, rays.size() - first); ++lane) {
      const bool hit = any ? (occluded >> lane & 1u) != 0 : hits.mesh[lane] != kNoHit;
      answers[first + lane] = {
          hit ? hits.mesh[lane] : kNothing, hits.triangle[lane], hits.u[lane], hits.v[lane], hits.distance[lane], 1, 0};
    }
  }
  return answers;
}

inline bool is_hit(const RayAnswer& answer) { return answer.mesh != kNothing; }

// Whether to float it is a matter of rounding that the hole of a mask is where the hit is: a texture coordinate of size
// s in a texture of t texels errs a few s 2^-24 t texels, and what the weights err; neighbouring texels may be black
// and white.
inline bool may_be_a_hole(const Scene& scene, const RayAnswer& hit, double weight_tolerance) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Material& material = scene.materials[mesh.material];
  const TextureSlot& slot = material.base_colour_texture;
  if (!can_have_holes(scene, mesh) || slot.texture < 0) return false;
  const MipImage::Level& finest = scene.textures[static_cast<std::size_t>(slot.texture)].image->levels[0];
  double size = 1;
  for (int corner = 0; corner < 3; ++corner) {
    const Vec2 uv = slot.transform(mesh.uv[slot.uv_set].at(mesh.indices[3 * std::size_t(hit.triangle) + corner]));
    size = std::max({size, std::abs(double(uv.x)), std::abs(double(uv.y))});
  }
  const double tolerance = (8 * 0x1p-24 + 2 * weight_tolerance) * size * std::max(finest.width, finest.height);
  const double alpha = surface_alpha(scene, {hit.mesh, hit.triangle, hit.u, hit.v});
  return std::abs(alpha - double(material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 0.5f)) <= tolerance;
}

// What the two have in common and what not.
struct HitComparison {
  std::size_t met = 0;           // rays that meet something on the device
  std::size_t set_apart = 0;     // another triangle, as rounding may have it: on an edge, at the end of a ray or hole
  std::size_t coincident = 0;    // another triangle, at the same distance
  std::size_t wrong = 0;         // another triangle, for no such reason
  std::size_t off_distance = 0;  // of all hits on the device, against double precision
  double turns = 0;
};

enum class Difference { none, set_apart, coincident, wrong };

//   exact(ray, hit)  ExactHit, with the tolerances of the two that are compared
template <class Exact>
Difference difference(const Scene& scene, const RayQuery& ray, const RayAnswer& a, const RayAnswer& b,
                      const Exact& exact_of) {
  if (is_hit(a) == is_hit(b) && (!is_hit(a) || (a.mesh == b.mesh && a.triangle == b.triangle))) return Difference::none;
  const auto exact = [&](const RayAnswer& hit) { return exact_of(ray, hit); };
  const auto contested = [&](const RayAnswer& hit) {
    const ExactHit e = exact(hit);
    const bool at_the_end = std::abs(e.distance - double(ray.farthest)) <= e.distance_tolerance ||
                            std::abs(e.distance - double(ray.nearest)) <= e.distance_tolerance;
    return e.is_contested() || at_the_end || may_be_a_hole(scene, hit, e.weight_tolerance);
  };
  // One of two casters missed what the other met.
  const bool nearer_a = is_hit(a) && (!is_hit(b) || exact(a).distance < exact(b).distance);
  if (contested(nearer_a ? a : b)) return Difference::set_apart;
  if (!is_hit(a) || !is_hit(b)) return Difference::wrong;
  const ExactHit in_a = exact(a), in_b = exact(b);
  const double tolerance = in_a.distance_tolerance + in_b.distance_tolerance;
  return std::abs(in_a.distance - in_b.distance) <= tolerance ? Difference::coincident : Difference::wrong;
}

template <class Exact>
HitComparison compare_hits(const Scene& scene, const std::vector<RayQuery>& rays, const std::vector<RayAnswer>& device,
                           const std::vector<RayAnswer>& embree, const Exact& exact_of) {
  HitComparison c;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayAnswer &found = device[i], &expected = embree[i];
    EXPECT_EQ(found.complete, 1u);
    c.turns += found.turns;
    if (is_hit(found)) {
      ++c.met;
      const ExactHit exact = exact_of(rays[i], found);
      const bool inside = exact.is_at_an_edge || exact.least_weight >= -exact.weight_tolerance;
      c.off_distance += !inside || !(std::abs(exact.distance - double(found.distance)) <= exact.distance_tolerance);
    }
    const Difference d = difference(scene, rays[i], found, expected, exact_of);
    c.set_apart += d == Difference::set_apart, c.coincident += d == Difference::coincident;
    c.wrong += d == Difference::wrong;
  }
  return c;
}

// Of two that cast rays in float.
inline HitComparison compare_hits(const Scene& scene, const std::vector<RayQuery>& rays,
                                  const std::vector<RayAnswer>& device, const std::vector<RayAnswer>& embree) {
  return compare_hits(scene, rays, device, embree, [&](const RayQuery& ray, const RayAnswer& hit) {
    return exact_hit(scene, ray, hit.mesh, hit.triangle);
  });
}

}  // namespace luciole::test
