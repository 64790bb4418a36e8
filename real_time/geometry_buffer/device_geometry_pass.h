// SPDX-License-Identifier: Apache-2.0
// Pass geometry_buffer on a Vulkan device: the kernel geometry_buffer.comp, a primary ray per pixel.
#pragma once
#include "gpu/command_list.h"
#include "real_time/device_scene/device_scene.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/geometry_buffer/geometry_records.h"
#include "real_time/shading/shading_records.h"

namespace luciole {

// A view of a scene, as GeometryBufferInputs.
struct DeviceView {
  Camera camera;
  std::uint32_t width = 0, height = 0;  // [pixels]
  Vec2 sub_pixel{0.5f, 0.5f};           // where in the pixel the rays go, [0,1)^2
};

// What the pass writes: records of width x height pixels, row-major.
struct GeometryOnDevice {
  gpu::Buffer pixels;      // PixelRecord, as culling and shading read them
  gpu::Buffer surfaces;    // SurfaceRecord
  gpu::Buffer unfinished;  // word, see GeometryPush

  static Result<GeometryOnDevice> create(gpu::Device& device, std::uint32_t width, std::uint32_t height);
};

class DeviceGeometryPass {
 public:
  static Result<DeviceGeometryPass> create(gpu::Device& device);

  void record(gpu::CommandList& list, const DeviceScene& scene, const DeviceView& view,
              const GeometryOnDevice& to) const;

 private:
  gpu::Kernel kernel_;
};

// Failed unless that many rays are none.
Status all_finished(word_ unfinished);

// What the kernels of both passes are told.
GeometryPush geometry_push(const DeviceScene& scene, const DeviceView& view, const GeometryOnDevice& to);

// Brings what the pass wrote into the planes of a geometry buffer. Fails where rays met more than kernels can ask.
Status read_back(gpu::Device& device, const GeometryOnDevice& from, const DeviceView& view, GeometryBuffer& to);

}  // namespace luciole
