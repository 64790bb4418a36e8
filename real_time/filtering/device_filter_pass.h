// SPDX-License-Identifier: Apache-2.0
// Pass filtering on a Vulkan device: the kernel filter_pixels.comp. It makes what BilateralFilterPass makes, from the
// sums that shading, or accumulation after it, left on the device.
#pragma once
#include "gpu/command_list.h"
#include "real_time/filtering/filter_radius.h"
#include "real_time/geometry_buffer/geometry_buffer.h"

namespace luciole {

// What the kernel reads and writes for one kind of light.
struct FilterBuffers {
  const gpu::Buffer* pixels;     // PixelRecord
  const gpu::Buffer* sums;       // PixelSums, per pixel
  const gpu::Buffer* more_sums;  // to be added to these; null: none
  const gpu::Buffer* filtered;   // PixelLight, per pixel; 0 for the sky
  const gpu::Buffer* counts;     // FilterCounts
  bool weighed = false;          // the sums have the weight n^2 already: those of DeviceAccumulationPass
};

class DeviceFilterPass {
 public:
  //   interleave  n: sums that are not weighed are weighted by n^2
  static Result<DeviceFilterPass> create(gpu::Device& device, FilterRadius radius, std::uint32_t interleave);

  // Of `geometry` the size and the camera.
  void record(gpu::CommandList& list, const FilterBuffers& buffers, const GeometryBuffer& geometry) const;

 private:
  gpu::Kernel kernel_;
  float weight_ = 1;
};

}  // namespace luciole
