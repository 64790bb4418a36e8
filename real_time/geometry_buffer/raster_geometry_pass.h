// SPDX-License-Identifier: Apache-2.0
// Pass geometry_buffer on a Vulkan device that rasterises: triangles are drawn into an image that says which of them
// each pixel shows (visibility*), and a kernel finds the surfaces there. Makes what DeviceGeometryPass makes; how the
// two differ: docs/decisions/rasterised_geometry.md.
#pragma once
#include "real_time/geometry_buffer/device_geometry_pass.h"
#include "real_time/geometry_buffer/visibility_records.h"

namespace luciole {

class RasterGeometryPass {
 public:
  //   width, height  of the largest view [pixels]
  //   meshes         of the scene that has most
  // Fails where the device does not rasterise (gpu::DeviceDescription::rasterises), or no images as large.
  static Result<RasterGeometryPass> create(gpu::Device& device, std::uint32_t width, std::uint32_t height,
                                           std::uint32_t meshes);

  // to.unfinished becomes 0: there are no rays that could give up.
  void record(gpu::CommandList& list, const DeviceScene& scene, const DeviceView& view,
              const GeometryOnDevice& to) const;

 private:
  gpu::Kernel choose_draws_, resolve_;
  gpu::RasterPipeline opaque_, masked_;
  gpu::Image visibility_, depth_;
  gpu::Buffer shown_;  // the visibility image, where kernels can read it
  gpu::Buffer draws_;  // DrawRecord, two per mesh
  std::uint32_t most_meshes_ = 0;
};

// Of a view. `bounds`: of all that may be drawn.
Projection projection_of(const DeviceView& view, const Bounds& bounds);

}  // namespace luciole
