// SPDX-License-Identifier: Apache-2.0
#include "real_time/direct_light/device_direct_light_pass.h"

#include <algorithm>

namespace luciole {

extern const gpu::ShaderCode light_pixels;

namespace {

constexpr std::uint32_t kGroup = 64;   // invocations of a workgroup of light_pixels.comp
constexpr std::uint32_t kAtOnce = 16;  // sources of a dispatch: shadow rays take long

}  // namespace

Result<DeviceDirectLightPass> DeviceDirectLightPass::create(gpu::Device& device) {
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, light_pixels, sizeof(DirectPush));
  if (!kernel) return kernel.error();
  DeviceDirectLightPass pass;
  pass.kernel_ = std::move(*kernel);
  return pass;
}

void DeviceDirectLightPass::record(gpu::CommandList& list, const DirectLightInputs& inputs, const gpu::Buffer& radiance,
                                   const gpu::Buffer& unfinished) const {
  DirectPush push{};
  push.scene = inputs.scene.address();
  push.pixels = inputs.geometry.pixels.address(), push.surfaces = inputs.geometry.surfaces.address();
  push.sources = inputs.sources.address(), push.radiance = radiance.address();
  push.unfinished = unfinished.address();
  const Vec3 eye = inputs.view.camera.eye;
  push.eye[0] = eye.x, push.eye[1] = eye.y, push.eye[2] = eye.z;
  push.surface_offset = inputs.surface_offset;
  push.pixel_count = inputs.view.width * inputs.view.height;
  list.begin_pass("direct_light");
  do {  // once also without a source: it writes black
    push.source_count = std::min(kAtOnce, inputs.source_count - push.first_source);
    list.dispatch(kernel_, push, (push.pixel_count + kGroup - 1) / kGroup);
    list.barrier();
    push.first_source += push.source_count;
  } while (push.first_source < inputs.source_count);
}

}  // namespace luciole
