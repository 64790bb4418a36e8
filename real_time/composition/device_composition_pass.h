// SPDX-License-Identifier: Apache-2.0
// Pass composition on a Vulkan device: the kernel compose_pixels.comp. It makes the picture that compose()
// (composition.h) makes, with pixels that are not finite black, and layers that are parts of it.
#pragma once
#include "gpu/command_list.h"
#include "real_time/composition/composition_records.h"

namespace luciole {

// What the kernel reads and writes. Light that is null is not there; of indirect light and of that of many lights there
// is the filtered one or the noisy one.
struct CompositionBuffers {
  const gpu::Buffer* pixels;               // PixelRecord
  const gpu::Buffer* surfaces;             // SurfaceRecord
  const gpu::Buffer* direct = nullptr;     // PixelColour: radiance by the primary lights
  const gpu::Buffer* indirect = nullptr;   // PixelLight, filtered
  const gpu::Buffer* many = nullptr;       // PixelLight, filtered
  const gpu::Buffer* sums = nullptr;       // PixelSums of indirect light
  const gpu::Buffer* more_sums = nullptr;  // to be added to these
  const gpu::Buffer* many_sums = nullptr;  // PixelSums of many lights
  float weight = 1;                        // of the sums: n^2, or 1 where accumulation left them
  bool with_emission = true;               // of surfaces and sky
  const gpu::Buffer* picture;              // PixelColour per pixel
  const gpu::Buffer* counts;               // CompositionCounts
};

class DeviceCompositionPass {
 public:
  static Result<DeviceCompositionPass> create(gpu::Device& device);

  // Of a picture of that size [pixels].
  void record(gpu::CommandList& list, const CompositionBuffers& buffers, std::uint32_t width,
              std::uint32_t height) const;

 private:
  gpu::Kernel kernel_;
};

}  // namespace luciole
