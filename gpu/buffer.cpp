// SPDX-License-Identifier: Apache-2.0
#include "gpu/buffer.h"

#include <algorithm>
#include <utility>

#include "gpu/vulkan_answer.h"

namespace luciole::gpu {

Result<Buffer> Buffer::create(Device& device, std::uint64_t bytes, BufferUse use) {
  Buffer buffer;
  buffer.device_ = &device;
  buffer.bytes_ = std::max<std::uint64_t>(bytes, 1);
  auto wanted = of_type<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  wanted.size = buffer.bytes_;
  wanted.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                 VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  const std::string attempt = "make a buffer on the Vulkan device";
  if (Status made = checked(vkCreateBuffer(device.handle(), &wanted, nullptr, &buffer.handle_), attempt); !made) {
    return made.error();
  }
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.handle(), buffer.handle_, &needs);
  Result<MemoryPiece> piece = device.memory().take(needs, use);
  if (!piece) return piece.error();
  buffer.piece_ = *piece;
  const VkResult bound = vkBindBufferMemory(device.handle(), buffer.handle_, piece->memory(), piece->offset);
  if (bound != VK_SUCCESS) return error_of(bound, attempt);
  auto which = of_type<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
  which.buffer = buffer.handle_;
  buffer.address_ = vkGetBufferDeviceAddress(device.handle(), &which);
  return buffer;
}

Status grow(Device& device, Buffer& buffer, std::uint64_t bytes, BufferUse use) {
  if (buffer.bytes() >= bytes && buffer.bytes() > 0) return Done{};
  buffer = Buffer();  // first, so that both need not fit
  Result<Buffer> larger = Buffer::create(device, bytes, use);
  if (!larger) return larger.error();
  buffer = std::move(*larger);
  return Done{};
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(device_, other.device_), std::swap(handle_, other.handle_), std::swap(piece_, other.piece_);
  std::swap(bytes_, other.bytes_), std::swap(address_, other.address_);
  return *this;
}

Buffer::~Buffer() {
  if (device_ == nullptr) return;
  vkDestroyBuffer(device_->handle(), handle_, nullptr);
  if (piece_.block != nullptr) device_->memory().give_back(piece_);
}

}  // namespace luciole::gpu
