// SPDX-License-Identifier: Apache-2.0
#include "gpu/image.h"

#include <algorithm>
#include <utility>

#include "gpu/vulkan_answer.h"

namespace luciole::gpu {
namespace {

constexpr const char* kAttempt = "make an image on the Vulkan device";

}  // namespace

VkFormat vulkan_format(PixelFormat format) {
  return format == PixelFormat::depth ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_R32G32_UINT;
}

VkImageAspectFlags Image::aspect() const {
  return format_ == PixelFormat::depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

Result<Image> Image::create(Device& device, std::uint32_t width, std::uint32_t height, PixelFormat format) {
  const VkPhysicalDeviceLimits& limits = device.limits();
  if (width > std::min(limits.maxImageDimension2D, limits.maxFramebufferWidth) ||
      height > std::min(limits.maxImageDimension2D, limits.maxFramebufferHeight)) {
    return Error{ErrorKind::failed, "the Vulkan device '" + device.description().name + "' draws no images of " +
                                        std::to_string(width) + "x" + std::to_string(height) + " pixels"};
  }
  Image image;
  image.device_ = &device;
  image.format_ = format;
  image.width_ = std::max(width, 1u), image.height_ = std::max(height, 1u);
  if (Status placed = image.place(); !placed) return placed.error();
  if (Status made = image.make_view(); !made) return made.error();
  return image;
}

Status Image::place() {
  auto wanted = of_type<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  wanted.imageType = VK_IMAGE_TYPE_2D;
  wanted.format = vulkan_format(format_);
  wanted.extent = {width_, height_, 1};
  wanted.mipLevels = wanted.arrayLayers = 1;
  wanted.samples = VK_SAMPLE_COUNT_1_BIT;
  wanted.tiling = VK_IMAGE_TILING_OPTIMAL;
  wanted.usage = format_ == PixelFormat::depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                               : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  if (Status made = checked(vkCreateImage(device_->handle(), &wanted, nullptr, &handle_), kAttempt); !made) return made;
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_->handle(), handle_, &needs);
  Result<MemoryPiece> piece = device_->memory().take(needs, BufferUse::attachment);
  if (!piece) return piece.error();
  piece_ = *piece;
  return checked(vkBindImageMemory(device_->handle(), handle_, piece->memory(), piece->offset), kAttempt);
}

Status Image::make_view() {
  auto wanted = of_type<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  wanted.image = handle_;
  wanted.viewType = VK_IMAGE_VIEW_TYPE_2D;
  wanted.format = vulkan_format(format_);
  wanted.subresourceRange = {aspect(), 0, 1, 0, 1};
  return checked(vkCreateImageView(device_->handle(), &wanted, nullptr, &view_), kAttempt);
}

Image& Image::operator=(Image&& other) noexcept {
  std::swap(device_, other.device_), std::swap(handle_, other.handle_), std::swap(view_, other.view_);
  std::swap(piece_, other.piece_), std::swap(format_, other.format_);
  std::swap(width_, other.width_), std::swap(height_, other.height_);
  return *this;
}

Image::~Image() {
  if (device_ == nullptr) return;
  vkDestroyImageView(device_->handle(), view_, nullptr);
  vkDestroyImage(device_->handle(), handle_, nullptr);
  if (piece_.block != nullptr) device_->memory().give_back(piece_);
}

}  // namespace luciole::gpu
