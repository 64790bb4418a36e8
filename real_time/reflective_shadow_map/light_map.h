// SPDX-License-Identifier: Apache-2.0
// The map of one primary light: which ray each texel sends, and how much flux travels along it.
#pragma once
#include <cstdint>
#include <vector>

#include "real_time/reflective_shadow_map/basis.h"
#include "real_time/reflective_shadow_map/cell_partition.h"
#include "real_time/reflective_shadow_map/light_map_records.h"
#include "real_time/reflective_shadow_map/primary_light.h"

namespace luciole {

// A photon bundle that leaves a light through one texel.
struct TexelRay {
  Vec3 origin;     // [m]
  Vec3 direction;  // unit
  Vec3 flux;       // Phi [W]: intensity there times the texel's solid angle, or irradiance times its area
};

// All texels of a map have the same measure, because the maps preserve area (equations/direction_map.h). With samples
// drawn uniformly in the texels the mean of the summed flux is the light's power exactly.
class LightMap {
 public:
  LightMap(const PunctualLight& light, std::uint32_t texels, const Bounds& scene_bounds);

  std::uint32_t size() const { return cells_.size(); }
  const CellPartition& cells() const { return cells_; }
  //   within  where in the texel, [0,1]^2; (.5, .5) is its centre
  TexelRay ray(std::uint32_t texel, Vec2 within) const;
  // For kernels of a device, which make the rays by themselves.
  LightMapRecord record(std::uint32_t first_texel) const;
  // Area across the ray that a texel stands for at some distance [m^2].
  float cross_section(float distance) const { return parallel_area_ + solid_angle_ * distance * distance; }

 private:
  PunctualLight light_;
  Basis frame_;
  SunRectangle rectangle_;
  CellPartition cells_;
  float solid_angle_ = 0;    // of one texel [sr]; 0 for a sun
  float parallel_area_ = 0;  // of one texel [m^2]; 0 for a point or spot light
};

// Shares a number of texels in proportion to power, by largest remainders: the shares sum to `total`. Powers that are
// not positive numbers get nothing, unless all are such: then all share alike.
std::vector<std::uint32_t> share_texels(const std::vector<float>& powers, std::uint32_t total);

}  // namespace luciole
