// SPDX-License-Identifier: Apache-2.0
// The part of a command list that draws.
#include <algorithm>

#include "base/assert.h"
#include "gpu/command_list.h"
#include "gpu/vulkan_answer.h"

namespace luciole::gpu {
namespace {

constexpr VkPipelineStageFlags2 kKernelsAndCopies =
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkPipelineStageFlags2 kDraws = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                         VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepthTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

// Whatever an image was before, it is drawn anew, after all that used it.
VkImageMemoryBarrier2 drawn_anew(const Image& image) {
  const bool depth = image.format() == PixelFormat::depth;
  auto barrier = of_type<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
  barrier.dstStageMask = depth ? kDepthTests : VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  barrier.srcStageMask = barrier.dstStageMask | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  barrier.srcAccessMask =
      depth ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT : VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
  barrier.dstAccessMask = barrier.srcAccessMask | (depth ? VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT
                                                         : VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT);
  barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  barrier.newLayout = depth ? VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.handle();
  barrier.subresourceRange = {image.aspect(), 0, 1, 0, 1};
  return barrier;
}

VkRenderingAttachmentInfo cleared(const Image& image, VkImageLayout layout, VkAttachmentStoreOp at_the_end) {
  auto attachment = of_type<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  attachment.imageView = image.view();
  attachment.imageLayout = layout;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  attachment.storeOp = at_the_end;
  return attachment;
}

void wait_for(VkCommandBuffer commands, const VkMemoryBarrier2& memory, const VkImageMemoryBarrier2* images,
              std::uint32_t image_count) {
  auto dependency = of_type<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &memory;
  dependency.imageMemoryBarrierCount = image_count;
  dependency.pImageMemoryBarriers = images;
  vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

void CommandList::begin_rendering(const Image& colour, const Image& depth, std::uint32_t width, std::uint32_t height,
                                  const std::array<std::uint32_t, 2>& clear) {
  LUCIOLE_ASSERT_EQ(rendering_, false);
  LUCIOLE_ASSERT_LE(width, std::min(colour.width(), depth.width()));
  LUCIOLE_ASSERT_LE(height, std::min(colour.height(), depth.height()));
  auto written = of_type<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  written.srcStageMask = kKernelsAndCopies;
  written.srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
  written.dstStageMask = kDraws;
  written.dstAccessMask = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  const VkImageMemoryBarrier2 images[] = {drawn_anew(colour), drawn_anew(depth)};
  wait_for(commands_, written, images, 2);

  VkRenderingAttachmentInfo into =
      cleared(colour, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_ATTACHMENT_STORE_OP_STORE);
  std::copy_n(clear.data(), 2, into.clearValue.color.uint32);
  const VkRenderingAttachmentInfo nearest =
      cleared(depth, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, VK_ATTACHMENT_STORE_OP_DONT_CARE);
  auto rendering = of_type<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  rendering.renderArea.extent = {width, height};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &into;
  rendering.pDepthAttachment = &nearest;
  vkCmdBeginRendering(commands_, &rendering);
  const VkViewport viewport{0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
  vkCmdSetViewport(commands_, 0, 1, &viewport);
  vkCmdSetScissor(commands_, 0, 1, &rendering.renderArea);
  rendering_ = true;
}

void CommandList::record_draw(const RasterPipeline& pipeline, const void* push, std::size_t bytes,
                              const Buffer& commands, std::uint32_t first, std::uint32_t count) {
  LUCIOLE_ASSERT_EQ(rendering_, true);
  LUCIOLE_ASSERT_EQ(bytes, pipeline.push_bytes());
  vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline());
  vkCmdPushConstants(commands_, pipeline.layout(), RasterPipeline::kStages, 0, static_cast<std::uint32_t>(bytes), push);
  constexpr std::uint32_t kStride = sizeof(VkDrawIndirectCommand);
  while (count > 0) {
    const std::uint32_t now = std::min(count, device_->limits().maxDrawIndirectCount);
    vkCmdDrawIndirect(commands_, commands.handle(), std::uint64_t(first) * kStride, now, kStride);
    first += now, count -= now;
  }
}

void CommandList::end_rendering(const Image& colour) {
  LUCIOLE_ASSERT_EQ(rendering_, true);
  rendering_ = false;
  vkCmdEndRendering(commands_);
  auto done = of_type<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  done.srcStageMask = kDraws;
  done.dstStageMask = kKernelsAndCopies;
  VkImageMemoryBarrier2 drawn = drawn_anew(colour);
  drawn.srcStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  drawn.oldLayout = drawn.newLayout;
  drawn.dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  drawn.dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT;
  drawn.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  wait_for(commands_, done, &drawn, 1);
}

void CommandList::copy(const Image& from, const Buffer& to, std::uint32_t width, std::uint32_t height) {
  VkBufferImageCopy region{};
  region.imageSubresource = {from.aspect(), 0, 0, 1};
  region.imageExtent = {width, height, 1};
  vkCmdCopyImageToBuffer(commands_, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(), 1, &region);
}

}  // namespace luciole::gpu
