// SPDX-License-Identifier: Apache-2.0
// What is drawn into: one value per pixel in the device's memory. Lists bring it from layout to layout
// (CommandList::begin_rendering); nothing but a copy reads it.
#pragma once
#include "gpu/device.h"

namespace luciole::gpu {

enum class PixelFormat : std::uint8_t {
  two_words,  // unsigned, 32 bits each
  depth       // float
};

VkFormat vulkan_format(PixelFormat format);

class Image {
 public:
  // Of at least one pixel. Fails where the device draws no images as large.
  static Result<Image> create(Device& device, std::uint32_t width, std::uint32_t height, PixelFormat format);
  Image() = default;
  Image(Image&& other) noexcept { *this = std::move(other); }
  Image& operator=(Image&& other) noexcept;
  ~Image();

  VkImage handle() const { return handle_; }
  VkImageView view() const { return view_; }
  VkImageAspectFlags aspect() const;
  PixelFormat format() const { return format_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  Status place();
  Status make_view();

  Device* device_ = nullptr;
  VkImage handle_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  MemoryPiece piece_;
  PixelFormat format_ = PixelFormat::two_words;
  std::uint32_t width_ = 0, height_ = 0;
};

}  // namespace luciole::gpu
