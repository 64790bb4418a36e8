// SPDX-License-Identifier: Apache-2.0
// Reflection at one path vertex: evaluates and samples the BRDF of equations/ggx_brdf.h, diffuse and GGX by visible
// normals. Directions point away from the surface; zero below the shading or the geometric normal.
#pragma once
#include "base/vector.h"
#include "equations/cpp/float.h"
#include "scene/surface.h"

namespace luciole {

struct BsdfSample {
  Vec3 direction{0, 0, 0};  // unit; 0: nothing is reflected there
  Vec3 weight{0, 0, 0};     // BRDF * cosine / pdf
  float pdf = 0;            // [1/sr], both lobes together
};

class Bsdf {
 public:
  //   to_eye         unit, towards the path's previous vertex
  //   diffuse_share  of the directions that the diffuse lobe would sample, how many it does; for the others `sample`
  //                  gives none, and densities are smaller in proportion   (0, 1]
  Bsdf(const SurfacePoint& point, Vec3 to_eye, float diffuse_share = 1);

  // BRDF times cosine [1/sr].
  Vec3 evaluate(Vec3 direction) const;
  // Density with which `sample` gives a direction [1/sr].
  float pdf(Vec3 direction) const;
  // place: two numbers in (0,1); lobe: one.
  BsdfSample sample(Vec2 place, float lobe) const;

  const f32::FixedDirectionBrdf& fixed() const { return fixed_; }
  Vec3 diffuse_albedo() const { return diffuse_albedo_; }
  Vec3 geometric_normal() const { return geometric_normal_; }

 private:
  bool above(Vec3 direction) const {
    return dot(direction, fixed_.normal) > 0 && dot(direction, geometric_normal_) > 0;
  }

  f32::FixedDirectionBrdf fixed_;
  Vec3 diffuse_albedo_, geometric_normal_;
  float ggx_alpha_;
  float specular_chance_, diffuse_chance_;  // of sampling the lobe
};

// Two unit vectors that complete a unit `normal` to a right-handed frame.   [Duff et al. 2017]
struct TangentFrame {
  Vec3 x, y, z;
  explicit TangentFrame(Vec3 normal);
  Vec3 world(Vec3 local) const { return x * local.x + y * local.y + z * local.z; }
  Vec3 local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

}  // namespace luciole
