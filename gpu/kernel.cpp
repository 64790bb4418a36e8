// SPDX-License-Identifier: Apache-2.0
#include "gpu/kernel.h"

#include <string>
#include <utility>

#include "gpu/shader_module.h"

namespace luciole::gpu {
namespace {

VkResult lay_out(VkDevice device, std::uint32_t push_bytes, VkPipelineLayout& layout) {
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
  auto wanted = of_type<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  wanted.pushConstantRangeCount = push_bytes > 0 ? 1 : 0;
  wanted.pPushConstantRanges = &push;
  return vkCreatePipelineLayout(device, &wanted, nullptr, &layout);
}

VkResult compile(VkDevice device, VkShaderModule module, VkPipelineLayout layout,
                 const std::vector<std::uint32_t>& constants, VkPipeline& pipeline) {
  std::vector<VkSpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < constants.size(); ++i) entries.push_back({i, 4 * i, 4});
  const VkSpecializationInfo special{static_cast<std::uint32_t>(entries.size()), entries.data(), 4 * constants.size(),
                                     constants.data()};
  auto wanted = of_type<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  wanted.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  wanted.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
  wanted.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  wanted.stage.module = module;
  wanted.stage.pName = "main";
  wanted.stage.pSpecializationInfo = &special;
  wanted.layout = layout;
  return vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &wanted, nullptr, &pipeline);
}

}  // namespace

Result<Kernel> Kernel::create(Device& device, const ShaderCode& code, std::uint32_t push_bytes,
                              const std::vector<std::uint32_t>& constants) {
  const std::string attempt = std::string("compile the shader ") + code.name;
  Kernel kernel;
  kernel.device_ = &device;
  kernel.push_bytes_ = push_bytes;
  const ShaderModule module(device.handle(), code);
  if (module.answer != VK_SUCCESS) return error_of(module.answer, attempt);
  if (Status made = checked(lay_out(device.handle(), push_bytes, kernel.layout_), attempt); !made) return made.error();
  if (Status made =
          checked(compile(device.handle(), module.handle, kernel.layout_, constants, kernel.pipeline_), attempt);
      !made) {
    return made.error();
  }
  return kernel;
}

Kernel& Kernel::operator=(Kernel&& other) noexcept {
  std::swap(device_, other.device_), std::swap(layout_, other.layout_), std::swap(pipeline_, other.pipeline_);
  std::swap(push_bytes_, other.push_bytes_);
  return *this;
}

Kernel::~Kernel() {
  if (device_ == nullptr) return;
  vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
  vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
}

}  // namespace luciole::gpu
