// SPDX-License-Identifier: Apache-2.0
// A scene that can be asked for intersections. This is the door of ray_tracing; Embree stays behind it.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "base/result.h"
#include "ray_tracing/ray_packet.h"
#include "scene/scene.h"

namespace luciole {

struct RayTracingOptions {
  std::string isa;      // "avx512", "avx2", "baseline"; empty: the best of this processor
  bool robust = false;  // watertight at edges, about 10 % slower: for references
  // Blended materials: cut where their alpha is below one half; or a ray passes with probability 1 - alpha, decided by
  // its random bits and the triangle.
  bool blend_at_random = false;
  std::uint64_t memory_limit_bytes = 0;  // Embree may not hold more than this; 0: no limit
};

class RayScene {
 public:
  // Builds the hierarchy on all threads of the current arena. Fails with out_of_memory, or with bad_scene where a
  // triangle refers to a vertex that does not exist.
  static Result<RayScene> create(std::shared_ptr<const Scene> scene, const RayTracingOptions& options = {});

  // Both sides of a triangle are met; holes of alpha-masked materials are not.
  HitPacket intersect(const RayPacket& rays, Coherence coherence) const;
  // Bit i is set if something lies strictly between nearest and farthest on ray i.
  std::uint32_t occluded(const RayPacket& rays, Coherence coherence) const;

  const Scene& scene() const { return *scene_; }
  const Bounds& bounds() const { return bounds_; }  // of all triangles; empty bounds if there is none

  // How far from a surface a ray has to start so that it misses the surface it starts on [m]. The scene's largest
  // coordinate M times 2^-19: a point interpolated on a triangle and the plane that Embree rebuilds relative to the
  // ray's origin each carry a few roundings of M, together below 2^-21 M.
  float surface_offset() const { return surface_offset_; }
  // geometric_normal: unit, on the side where the ray goes.
  Vec3 offset_from_surface(Vec3 point, Vec3 geometric_normal) const {
    return point + geometric_normal * surface_offset_;
  }

  std::uint64_t memory_bytes() const;  // what Embree holds now

 private:
  struct Embree;  // device, scene and what its callbacks write to
  struct DeleteEmbree {
    void operator()(Embree*) const;
  };
  RayScene() = default;

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Embree, DeleteEmbree> embree_;
  Bounds bounds_;
  float surface_offset_ = 0;
};

}  // namespace luciole
