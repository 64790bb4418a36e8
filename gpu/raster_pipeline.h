// SPDX-License-Identifier: Apache-2.0
// A vertex and a fragment shader, ready to draw triangles. Both get the same push constants and find what they need by
// address: there is no vertex input. Both sides of triangles are drawn; what has the greatest depth stays (reversed z:
// depth is near / distance), of equals the first.
#pragma once
#include "gpu/image.h"
#include "gpu/shader_code.h"

namespace luciole::gpu {

class RasterPipeline {
 public:
  //   push_bytes  of the push constants, a multiple of 4, at most 128
  //   colour      of the image that is drawn into, beside one of depth
  // Fails where the device only computes (DeviceDescription::rasterises).
  static Result<RasterPipeline> create(Device& device, const ShaderCode& vertex, const ShaderCode& fragment,
                                       std::uint32_t push_bytes, PixelFormat colour);
  RasterPipeline() = default;
  RasterPipeline(RasterPipeline&& other) noexcept { *this = std::move(other); }
  RasterPipeline& operator=(RasterPipeline&& other) noexcept;
  ~RasterPipeline();

  static constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
  VkPipeline pipeline() const { return pipeline_; }
  VkPipelineLayout layout() const { return layout_; }
  std::uint32_t push_bytes() const { return push_bytes_; }

 private:
  Device* device_ = nullptr;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  std::uint32_t push_bytes_ = 0;
};

}  // namespace luciole::gpu
