// SPDX-License-Identifier: Apache-2.0
#include "gpu/raster_pipeline.h"

#include <string>
#include <utility>

#include "gpu/shader_module.h"

namespace luciole::gpu {
namespace {

VkResult lay_out(VkDevice device, std::uint32_t push_bytes, VkPipelineLayout& layout) {
  const VkPushConstantRange push{RasterPipeline::kStages, 0, push_bytes};
  auto wanted = of_type<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  wanted.pushConstantRangeCount = push_bytes > 0 ? 1 : 0;
  wanted.pPushConstantRanges = &push;
  return vkCreatePipelineLayout(device, &wanted, nullptr, &layout);
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which, VkShaderModule module) {
  auto made = of_type<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  made.stage = which;
  made.module = module;
  made.pName = "main";
  return made;
}

// All that is fixed: the structures that a pipeline refers to while it is made.
struct FixedFunctions {
  VkPipelineVertexInputStateCreateInfo no_input =
      of_type<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  VkPipelineInputAssemblyStateCreateInfo triangles =
      of_type<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  VkPipelineViewportStateCreateInfo viewport =
      of_type<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  VkPipelineRasterizationStateCreateInfo filled =
      of_type<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  VkPipelineMultisampleStateCreateInfo one_sample =
      of_type<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  VkPipelineDepthStencilStateCreateInfo depth =
      of_type<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  VkPipelineColorBlendStateCreateInfo written =
      of_type<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  VkPipelineDynamicStateCreateInfo dynamic =
      of_type<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
  VkPipelineColorBlendAttachmentState all_channels{};
  const VkDynamicState states[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};

  FixedFunctions() {
    triangles.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport.viewportCount = viewport.scissorCount = 1;
    filled.polygonMode = VK_POLYGON_MODE_FILL;
    filled.cullMode = VK_CULL_MODE_NONE;
    filled.lineWidth = 1;
    one_sample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER;
    all_channels.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    written.attachmentCount = 1;
    written.pAttachments = &all_channels;
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = states;
  }
  FixedFunctions(const FixedFunctions&) = delete;
  FixedFunctions& operator=(const FixedFunctions&) = delete;

  void enter(VkGraphicsPipelineCreateInfo& wanted) const {
    wanted.pVertexInputState = &no_input;
    wanted.pInputAssemblyState = &triangles;
    wanted.pViewportState = &viewport;
    wanted.pRasterizationState = &filled;
    wanted.pMultisampleState = &one_sample;
    wanted.pDepthStencilState = &depth;
    wanted.pColorBlendState = &written;
    wanted.pDynamicState = &dynamic;
  }
};

VkResult compile(VkDevice device, const ShaderModule& vertex, const ShaderModule& fragment, VkPipelineLayout layout,
                 PixelFormat colour, VkPipeline& pipeline) {
  const VkPipelineShaderStageCreateInfo stages[] = {stage(VK_SHADER_STAGE_VERTEX_BIT, vertex.handle),
                                                    stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.handle)};
  const VkFormat colour_format = vulkan_format(colour);
  auto targets = of_type<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
  targets.colorAttachmentCount = 1;
  targets.pColorAttachmentFormats = &colour_format;
  targets.depthAttachmentFormat = vulkan_format(PixelFormat::depth);
  const FixedFunctions fixed;
  auto wanted = of_type<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  wanted.pNext = &targets;
  wanted.stageCount = 2;
  wanted.pStages = stages;
  wanted.layout = layout;
  fixed.enter(wanted);
  return vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &wanted, nullptr, &pipeline);
}

}  // namespace

Result<RasterPipeline> RasterPipeline::create(Device& device, const ShaderCode& vertex, const ShaderCode& fragment,
                                              std::uint32_t push_bytes, PixelFormat colour) {
  if (!device.description().rasterises) {
    return Error{ErrorKind::failed, "the Vulkan device '" + device.description().name + "' does not rasterise"};
  }
  const std::string attempt = std::string("compile the shaders ") + vertex.name + " and " + fragment.name;
  RasterPipeline made;
  made.device_ = &device;
  made.push_bytes_ = push_bytes;
  const ShaderModule vertex_module(device.handle(), vertex), fragment_module(device.handle(), fragment);
  for (const ShaderModule* module : {&vertex_module, &fragment_module}) {
    if (module->answer != VK_SUCCESS) return error_of(module->answer, attempt);
  }
  Status done = checked(lay_out(device.handle(), push_bytes, made.layout_), attempt);
  if (done) {
    done = checked(compile(device.handle(), vertex_module, fragment_module, made.layout_, colour, made.pipeline_),
                   attempt);
  }
  if (!done) return done.error();
  return made;
}

RasterPipeline& RasterPipeline::operator=(RasterPipeline&& other) noexcept {
  std::swap(device_, other.device_), std::swap(layout_, other.layout_), std::swap(pipeline_, other.pipeline_);
  std::swap(push_bytes_, other.push_bytes_);
  return *this;
}

RasterPipeline::~RasterPipeline() {
  if (device_ == nullptr) return;
  vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
  vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
}

}  // namespace luciole::gpu
