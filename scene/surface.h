// SPDX-License-Identifier: Apache-2.0
// What a ray meets: a point of a triangle, with its material evaluated there.
#pragma once
#include <cstdint>

#include "base/vector.h"
#include "scene/scene.h"

namespace luciole {

struct SurfaceHit {
  std::uint32_t mesh = 0, triangle = 0;  // indices in Scene::meshes and of the triangle in the mesh
  float u = 0, v = 0;                    // barycentric: point = (1-u-v) p0 + u p1 + v p2
};

struct SurfacePoint {
  Vec3 position;          // world [m]
  Vec3 geometric_normal;  // unit, on the viewer's side
  Vec3 shading_normal;    // unit, interpolated and normal-mapped, on the viewer's side of the triangle and of itself
  Vec3 base_colour;       // linear [1] in [0,1]: texture * vertex colour * factor
  float metallic;         // [1] in [0,1]
  float ggx_alpha;        // [TH17] alpha: roughness^2, at least 1e-3
  Vec3 diffuse_albedo;    // (1 - metallic) * base colour
  Vec3 f0;                // Fresnel reflectance at normal incidence
  float f90;              // and at grazing incidence
  Vec3 emission;          // radiance towards the viewer [W/(m^2 sr)]; none from the back of a single-sided material
  float alpha;            // coverage [1] in [0,1]; 1 for opaque materials
  bool front;             // the viewer sees the counter-clockwise side
};

// ggx_alpha of materials lies in [kLeastGgxAlpha, 1].
inline constexpr float kLeastGgxAlpha = 1e-3f;

//   ray_direction  unit, from the viewer to the surface
//   cone_width     diameter of the ray cone at the hit [m], for the textures' level of detail; 0: finest level
SurfacePoint evaluate_surface(const Scene& scene, const SurfaceHit& hit, Vec3 ray_direction, float cone_width);

// Coverage at a hit, from the finest texture level; 1 for opaque materials.
float surface_alpha(const Scene& scene, const SurfaceHit& hit);

// Whether a ray is stopped: alpha-masked materials where alpha reaches their cutoff, blended ones where it reaches 0.5
// (a renderer that lets rays through at random asks surface_alpha instead).
bool alpha_passes(const Scene& scene, const SurfaceHit& hit);

// Whether rays can pass anywhere on a mesh: only those need a ray filter.
//   blend_at_random  they pass blended surfaces wherever alpha is below 1, not below one half
bool can_have_holes(const Scene& scene, const Mesh& mesh, bool blend_at_random = false);

bool is_blended(const Scene& scene, std::uint32_t mesh);

}  // namespace luciole
