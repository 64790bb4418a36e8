// SPDX-License-Identifier: Apache-2.0
// Which triangles of a scene shine.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "scene/scene.h"
#include "scene/surface.h"

namespace luciole {

struct EmissiveTriangle {
  std::uint32_t mesh = 0, triangle = 0;
  float area = 0;          // [m^2], > 0
  Vec3 radiance{0, 0, 0};  // mean over the triangle, its texture and its holes included [W/(m^2 sr)]; some channel > 0
  bool both_sides = false;
};

// In the order of meshes and triangles, without those of unlit materials: they are seen and shine on nothing. Textures
// are averaged over 16 points, each at the level of detail of a sixteenth of the triangle.
std::vector<EmissiveTriangle> emissive_triangles(const Scene& scene);

// Radiance that leaves a point of a triangle on its shining side, its texture at a level of detail; holes do not count
// here.
Vec3 emission_at(const Scene& scene, const SurfaceHit& hit, float level_of_detail);

// Flux that leaves the triangle: pi * area * radiance per shining side [W].
Vec3 power(const EmissiveTriangle& triangle);

}  // namespace luciole
