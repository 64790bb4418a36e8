// SPDX-License-Identifier: Apache-2.0
// Pass direct_light on a Vulkan device: the kernel light_pixels.comp, shadow rays by the ray caster.
#pragma once
#include "gpu/command_list.h"
#include "real_time/device_scene/device_scene.h"
#include "real_time/direct_light/direct_records.h"
#include "real_time/geometry_buffer/device_geometry_pass.h"

namespace luciole {

struct DirectLightInputs {
  const DeviceScene& scene;
  float surface_offset;  // RayScene::surface_offset [m]
  const DeviceView& view;
  const GeometryOnDevice& geometry;  // of that view
  const gpu::Buffer& sources;        // DirectSource
  std::uint32_t source_count;
};

class DeviceDirectLightPass {
 public:
  static Result<DeviceDirectLightPass> create(gpu::Device& device);

  //   radiance    3 floats per pixel [W/(m^2 sr)]
  //   unfinished  word: rays that met more than kernels can ask are added to it
  void record(gpu::CommandList& list, const DirectLightInputs& inputs, const gpu::Buffer& radiance,
              const gpu::Buffer& unfinished) const;

 private:
  gpu::Kernel kernel_;
};

}  // namespace luciole
