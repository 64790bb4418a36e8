// SPDX-License-Identifier: Apache-2.0
#include "real_time/virtual_point_lights/device_placement_pass.h"

namespace luciole {

extern const gpu::ShaderCode place_lights;

Result<DevicePlacementPass> DevicePlacementPass::create(gpu::Device& device, std::uint32_t interleave) {
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, place_lights, sizeof(PlacementPush));
  if (!kernel) return kernel.error();
  DevicePlacementPass pass;
  pass.kernel_ = std::move(*kernel);
  pass.subsets_ = interleave * interleave;
  return pass;
}

void DevicePlacementPass::record(gpu::CommandList& list, const gpu::Buffer& texels, const gpu::Buffer& counts,
                                 std::uint32_t count, const PlacedLights& to) const {
  PlacementPush push{};
  push.texels = texels.address(), push.counts = counts.address();
  push.lights = to.lights->address(), push.ranges = to.ranges->address();
  push.texel_count = count, push.subsets = subsets_;
  list.begin_pass("virtual_point_lights");
  list.dispatch(kernel_, push, subsets_);
}

}  // namespace luciole
