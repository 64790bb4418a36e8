// SPDX-License-Identifier: Apache-2.0
// SPIR-V on its way into a pipeline, which needs it only while it is made.
#pragma once
#include "gpu/device.h"
#include "gpu/shader_code.h"
#include "gpu/vulkan_answer.h"

namespace luciole::gpu {

class ShaderModule {
 public:
  ShaderModule(VkDevice device, const ShaderCode& code) : device_(device) {
    auto wanted = of_type<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    wanted.codeSize = code.bytes;
    wanted.pCode = code.words;
    answer = vkCreateShaderModule(device, &wanted, nullptr, &handle);
  }
  ~ShaderModule() { vkDestroyShaderModule(device_, handle, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;

  VkShaderModule handle = VK_NULL_HANDLE;
  VkResult answer;

 private:
  VkDevice device_;
};

}  // namespace luciole::gpu
