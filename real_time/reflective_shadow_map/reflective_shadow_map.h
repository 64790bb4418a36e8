// SPDX-License-Identifier: Apache-2.0
// Door: what the primary lights see, one surface point per texel of their maps.   [Dachsbacher, Stamminger 2005]
#pragma once
#include <cstdint>
#include <vector>

#include "base/fold_seed.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/reflective_shadow_map/light_map.h"
#include "real_time/reflective_shadow_map/primary_light.h"

namespace luciole {

// Where a photon bundle met a surface. Normals are on the side that it came from.
struct SurfaceTexel {
  Vec3 position;          // world [m]
  Vec3 normal;            // shading normal, unit
  Vec3 geometric_normal;  // unit
  Vec3 incident;          // w_i, unit, back towards the light
  Vec3 flux;              // Phi, before reflection [W]; 0 where nothing was met
  Vec3 diffuse_albedo;
  Vec3 f0;
  float f90;
  float ggx_alpha;
  float area;  // the surface that the texel stands for [m^2]
};

// Where in its texel each ray goes.
struct TexelSampling {
  std::uint64_t vpl_seed = 0;  // 0: at the centre
  bool jitter = false;         // a new place each frame, also for seed 0
  std::uint64_t frame = 0;

  bool is_random() const { return vpl_seed != 0 || jitter; }
  std::uint32_t frame_word() const { return jitter ? folded(frame) : 0; }  // of the random numbers
};

// The maps of all primary lights, numbered through: texel i of map m has the key first_texel(m) + i.
class ReflectiveShadowMaps {
 public:
  // texels  in all, shared in proportion to power
  ReflectiveShadowMaps(const PrimaryLights& lights, const Bounds& scene_bounds, std::uint32_t texels);

  std::uint32_t texel_count() const { return first_.back(); }
  const std::vector<LightMap>& maps() const { return maps_; }
  std::uint32_t first_texel(std::size_t map) const { return first_[map]; }

  // One ray per texel; writes texels[key] for every key. Same bits for any number of threads.
  void render(const RayScene& scene, const TexelSampling& sampling, std::vector<SurfaceTexel>& texels) const;

 private:
  void trace_packet(const RayScene& scene, const TexelSampling& sampling, std::uint32_t first_key,
                    std::vector<SurfaceTexel>& texels) const;
  const LightMap& map_of(std::uint32_t key, std::uint32_t& texel) const;

  std::vector<LightMap> maps_;
  std::vector<std::uint32_t> first_;  // one more than maps: the last is the number of texels
};

}  // namespace luciole
