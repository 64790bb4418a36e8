// SPDX-License-Identifier: Apache-2.0
// Pass virtual_point_lights on a Vulkan device: the kernel place_lights.comp brings the lights of texels together.
#pragma once
#include "gpu/command_list.h"
#include "real_time/virtual_point_lights/placement_records.h"

namespace luciole {

// Lights in the order of subset_layout (light_range/subset_layout.h).
struct PlacedLights {
  const gpu::Buffer* lights;  // VplRecord
  const gpu::Buffer* ranges;  // SubsetRange, n^2 of them
};

class DevicePlacementPass {
 public:
  static Result<DevicePlacementPass> create(gpu::Device& device, std::uint32_t interleave);

  // Most records that it writes: every texel a light, and each subset filled up to a multiple of 16.
  std::uint64_t most_entries(std::uint32_t texels) const { return std::uint64_t(texels) + 15ull * subsets_; }

  //   texels  VplRecord, `count` of them
  //   counts  word per subset: its lights
  void record(gpu::CommandList& list, const gpu::Buffer& texels, const gpu::Buffer& counts, std::uint32_t count,
              const PlacedLights& to) const;

 private:
  gpu::Kernel kernel_;
  std::uint32_t subsets_ = 1;
};

}  // namespace luciole
