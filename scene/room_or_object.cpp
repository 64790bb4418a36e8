// SPDX-License-Identifier: Apache-2.0
#include "scene/room_or_object.h"

#include <algorithm>
#include <cmath>

#include "scene/line_of_sight.h"

namespace luciole {
namespace {

constexpr float kTwoPi = 6.28318531f;

// The limits lie in the gaps that 100 scenes and samples leave: fronts met by rooms from 0.84, by open grounds up to
// 0.73; light that leaves rooms up to 0.36, objects that are closed around their middle from 0.60.
constexpr std::size_t kDirections = 64;
constexpr std::size_t kLeavingLines = 256;  // a share of one half is known to 0.03
constexpr float kLeastFronts = 0.75f, kMostLeaving = 0.5f;
constexpr float kLeastHeight = 1.5f;  // [m]

struct Surface {
  double area = 0;     // [m^2]
  float diagonal = 0;  // of the bounds [m]
  double volume = 0;   // enclosed, by the divergence theorem; negative where fronts look inwards [m^3]
  Bounds bounds;
};

template <typename Visit>
void for_each_triangle(const Scene& scene, const Visit& visit) {
  for (const Mesh& mesh : scene.meshes) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const Vec3 a = mesh.positions[mesh.indices[i]];
      visit(a, mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
    }
  }
}

Surface measure(const Scene& scene) {
  Surface surface;
  surface.bounds = scene.bounds();
  surface.diagonal = surface.bounds.diagonal();
  const Vec3 centre = surface.bounds.centre();
  for_each_triangle(scene, [&](Vec3 a, Vec3 e1, Vec3 e2) {
    const Vec3 doubled = cross(e1, e2);
    surface.area += 0.5 * length(doubled);
    surface.volume += static_cast<double>(dot(doubled, a - centre)) / 6;
  });
  return surface;
}

float fraction(double value) { return static_cast<float>(value - std::floor(value)); }

// Lines from points that are even over the surface, cosine-distributed round the front's normal. Additive recurrences
// by badly approximable numbers: even for any count.
std::vector<SightLine> leaving_lines(const Scene& scene, const Surface& surface) {
  std::vector<SightLine> lines;
  double passed = 0;
  for_each_triangle(scene, [&](Vec3 a, Vec3 e1, Vec3 e2) {
    const Vec3 doubled = cross(e1, e2);
    passed += 0.5 * length(doubled);
    while (lines.size() < kLeavingLines) {
      const auto k = static_cast<double>(lines.size());
      if ((k + 0.5) / kLeavingLines * surface.area >= passed) break;
      const float s = std::sqrt(fraction(k * 0.7548776662)), t = fraction(k * 0.5698402910);
      const Vec3 point = a + e1 * (1 - s) + e2 * (s * t);
      const float y = 1 - 2 * fraction(k * 0.6180339887), angle = kTwoPi * fraction(k * 0.4142135624);
      const float radius = std::sqrt(1 - y * y);
      const Vec3 on_sphere(radius * std::cos(angle), y, radius * std::sin(angle));
      lines.push_back({point, normalize(normalize(doubled) + on_sphere * 0.999f), 1e-4f * surface.diagonal});
    }
  });
  return lines;
}

bool closed_around_middle(const Scene& scene, const Bounds& bounds) {
  std::vector<SightLine> lines;
  for (const Vec3 direction : even_directions(kDirections)) lines.push_back({middle_of_room(bounds), direction});
  const std::vector<Sight> sights = look_along(scene, lines);
  const auto fronts = std::count_if(sights.begin(), sights.end(), [](const Sight& s) { return s.met() && s.front; });
  return static_cast<float>(fronts) >= kLeastFronts * static_cast<float>(kDirections);
}

bool keeps_its_light(const Scene& scene, const Surface& surface) {
  const std::vector<Sight> sights = look_along(scene, leaving_lines(scene, surface));
  const auto leaving = std::count_if(sights.begin(), sights.end(), [](const Sight& s) { return !s.met(); });
  return static_cast<float>(leaving) < kMostLeaving * static_cast<float>(sights.size());
}

}  // namespace

Vec3 middle_of_room(const Bounds& bounds) {
  const Vec3 centre = bounds.centre();
  return {centre.x, bounds.low.y + (bounds.high.y - bounds.low.y) / 3, centre.z};
}

bool is_room(const Scene& scene) {
  const Surface surface = measure(scene);
  if (!(surface.area > 0)) return false;
  const bool one_can_stand = surface.bounds.high.y - surface.bounds.low.y >= kLeastHeight;
  if (!one_can_stand && surface.volume > 0) return false;
  return closed_around_middle(scene, surface.bounds) && keeps_its_light(scene, surface);
}

}  // namespace luciole
