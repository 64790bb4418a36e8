// SPDX-License-Identifier: Apache-2.0
#include "scene/framing_camera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/line_of_sight.h"
#include "scene/room_or_object.h"

namespace luciole {
namespace {

constexpr float kVerticalFov = 0.95f;  // [rad]
constexpr float kAspect = 4.0f / 3;    // width by height of the narrowest picture that holds an object whole
constexpr float kMargin = 1.05f;

Camera camera_inside(const Scene& scene, const Bounds& bounds) {
  const Vec3 size = bounds.high - bounds.low, middle = middle_of_room(bounds);
  const bool along_x = size.x >= size.z;
  const Vec3 axis = along_x ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
  const float reach = 0.45f * (along_x ? size.x : size.z);
  const std::vector<Sight> ends = look_along(scene, {{middle, axis}, {middle, -axis}});
  // The end that is further away, so that an open side (a stage, the Cornell box) is looked into and not out of.
  const bool positive = ends[0].distance > ends[1].distance;
  const float distance = std::min(0.9f * ends[positive ? 0 : 1].distance, reach);
  return look_at(middle + axis * (positive ? distance : -distance), middle, kVerticalFov);
}

// The sum of the triangles' normals by area [m^2]: nothing for what is closed, and where the fronts look otherwise.
Vec3 open_side(const Scene& scene) {
  Vec3 sum(0, 0, 0);
  for (const Mesh& mesh : scene.meshes) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const Vec3 a = mesh.positions[mesh.indices[i]];
      sum += cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a) * 0.5f;
    }
  }
  return sum;
}

// Unit, towards the eye: from the right above the front, which is +Z in glTF, unless the fronts of what is open (a
// backdrop, a single sheet) look another way by more than a twentieth of the bounds' largest side.
Vec3 towards_outside_eye(const Scene& scene, const Bounds& bounds) {
  const std::array<Vec3, 4> quarters = {Vec3(0.5f, 0.4f, 1), Vec3(1, 0.4f, -0.5f), Vec3(-1, 0.4f, 0.5f),
                                        Vec3(-0.5f, 0.4f, -1)};
  const Vec3 open = open_side(scene), size = bounds.high - bounds.low;
  const float largest_side = std::max({size.x * size.y, size.y * size.z, size.z * size.x});
  Vec3 best = quarters[0];
  for (const Vec3 quarter : quarters) {
    const Vec3 level(quarter.x - best.x, 0, quarter.z - best.z);
    if (dot(open, level) > 0.05f * largest_side) best = quarter;
  }
  return normalize(best);
}

// As near as all eight corners of the bounds are in the picture.
Camera camera_outside(const Scene& scene, const Bounds& bounds) {
  const Vec3 centre = bounds.centre(), half = (bounds.high - bounds.low) * 0.5f;
  const Vec3 towards_eye = towards_outside_eye(scene, bounds);
  const Camera view = look_at(centre + towards_eye, centre, kVerticalFov);
  const float slope = std::tan(0.5f * kVerticalFov);
  float distance = 1e-3f;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f, corner & 4 ? 1.0f : -1.0f);
    const Vec3 offset = half * sign;
    const float aside = std::max(std::abs(dot(offset, view.right)) / kAspect, std::abs(dot(offset, view.up)));
    distance = std::max(distance, kMargin * aside / slope + dot(offset, towards_eye));
  }
  return look_at(centre + towards_eye * distance, centre, kVerticalFov);
}

}  // namespace

Camera framing_camera(const Scene& scene) {
  const Bounds bounds = scene.bounds();
  if (!(bounds.low.x <= bounds.high.x)) return look_at({0, 0, 3}, {0, 0, 0}, kVerticalFov);
  return is_room(scene) ? camera_inside(scene, bounds) : camera_outside(scene, bounds);
}

}  // namespace luciole
