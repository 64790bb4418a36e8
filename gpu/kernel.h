// SPDX-License-Identifier: Apache-2.0
// A compute shader, ready to be dispatched.
#pragma once
#include <cstdint>
#include <vector>

#include "gpu/device.h"
#include "gpu/shader_code.h"

namespace luciole::gpu {

class Kernel {
 public:
  //   push_bytes  of its push constants, a multiple of 4, at most 128
  //   constants   values of specialisation constants 0, 1, 2, ...
  static Result<Kernel> create(Device& device, const ShaderCode& code, std::uint32_t push_bytes,
                               const std::vector<std::uint32_t>& constants = {});
  Kernel() = default;
  Kernel(Kernel&& other) noexcept { *this = std::move(other); }
  Kernel& operator=(Kernel&& other) noexcept;
  ~Kernel();

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
