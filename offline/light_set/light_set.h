// SPDX-License-Identifier: Apache-2.0
// Door: every light that a shadow ray can be sent to, triangles and lamps in one form. Lights at infinity are apart
// (infinite_lights.h).
#pragma once
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "base/vector.h"
#include "scene/scene.h"

namespace luciole {

inline constexpr std::uint32_t kNoLight = 0xffffffffu;

// Radiant intensity towards a unit direction w, mean over a triangle: intensity * s(w . axis), with
// s(c) = t for emitters and t^2 for lamps, t = clamp(max(c, -c * two_sided) * scale + offset, 0, 1).
// One cache line, and plain floats: kernels gather them.
struct alignas(64) LightRecord {
  float x, y, z;                 // centre [m]
  float radius;                  // of the sphere round the centre that holds the light [m]; 0 for lamps
  float axis_x, axis_y, axis_z;  // unit; a triangle's front normal
  float intensity;               // largest over directions, mean of R, G, B [W/sr]; > 0
  float reach_offset;            // sphere round all points that the light reaches in range r: its centre lies
  float reach_radius;            // reach_offset * r along the axis, its radius is reach_radius * r
  float scale, offset, two_sided;
  float lamp;          // 1: punctual; 0: emissive triangle
  std::uint32_t mesh;  // lamps: index in Scene::lights
  std::uint32_t triangle;

  Vec3 centre() const { return {x, y, z}; }
  Vec3 axis() const { return {axis_x, axis_y, axis_z}; }
};
static_assert(sizeof(LightRecord) == 64);

// s(c) above.
float directional_factor(const LightRecord& light, float cos_axis);

class LightSet {
 public:
  LightSet() = default;
  // Emissive triangles, point and spot lights; those without light are left out. Along a Morton curve, so that
  // neighbours in the list are neighbours in space.
  explicit LightSet(const Scene& scene);

  const AlignedVector<LightRecord>& records() const { return records_; }
  // Colour of a light's intensity over the mean of its channels: their mean is 1.
  Vec3 tint(std::uint32_t light) const { return tints_[light]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(records_.size()); }
  // The light of a triangle; kNoLight if it does not shine.
  std::uint32_t light_of(std::uint32_t mesh, std::uint32_t triangle) const {
    const std::vector<std::uint32_t>& lights = light_of_triangle_[mesh];
    return lights.empty() ? kNoLight : lights[triangle];
  }
  std::uint64_t memory_bytes() const;

 private:
  AlignedVector<LightRecord> records_;
  std::vector<Vec3> tints_;
  std::vector<std::vector<std::uint32_t>> light_of_triangle_;  // by mesh; empty where none of its triangles shines
};

}  // namespace luciole
