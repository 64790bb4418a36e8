// SPDX-License-Identifier: Apache-2.0
// Pass reflective_shadow_map on a Vulkan device: the kernel trace_light_maps.comp, a ray per texel.
#pragma once
#include "gpu/command_list.h"
#include "real_time/device_scene/device_scene.h"
#include "real_time/light_range/range_records.h"
#include "real_time/reflective_shadow_map/light_map_records.h"
#include "real_time/reflective_shadow_map/reflective_shadow_map.h"

namespace luciole {

// ReflectiveShadowMaps in a device's memory.
class LightMapsOnDevice {
 public:
  // Copies what it needs.
  static Result<LightMapsOnDevice> create(gpu::Device& device, const ReflectiveShadowMaps& maps);

  std::uint32_t map_count() const { return map_count_; }
  std::uint32_t texel_count() const { return texel_count_; }
  const gpu::Buffer& maps() const { return maps_; }    // LightMapRecord
  const gpu::Buffer& cells() const { return cells_; }  // CellRecord, per texel

 private:
  gpu::Buffer maps_, cells_;
  std::uint32_t map_count_ = 0, texel_count_ = 0;
};

// What the pass writes.
struct TexelsOnDevice {
  gpu::Buffer lights;  // VplRecord, per texel; is_light 0 where nothing is reflected
  gpu::Buffer counts;  // word per subset: its lights
};

class DeviceLightMapPass {
 public:
  //   interleave  n, of n^2 subsets
  static Result<DeviceLightMapPass> create(gpu::Device& device, std::uint32_t interleave);

  //   unfinished  word: rays that met more than kernels can ask are added to it
  void record(gpu::CommandList& list, const DeviceScene& scene, const LightMapsOnDevice& maps,
              const TexelSampling& sampling, const TexelsOnDevice& to, const gpu::Buffer& unfinished) const;

 private:
  gpu::Kernel kernel_;
  std::uint32_t subsets_ = 1;
};

}  // namespace luciole
