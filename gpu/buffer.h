// SPDX-License-Identifier: Apache-2.0
// A stretch of memory that kernels address, or that the CPU writes or reads.
#pragma once
#include <cstring>

#include "gpu/device.h"

namespace luciole::gpu {

class Buffer {
 public:
  // Of at least one byte, as Vulkan knows no empty buffers. Its contents are undefined.
  static Result<Buffer> create(Device& device, std::uint64_t bytes, BufferUse use);
  Buffer() = default;
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(Buffer&& other) noexcept;
  ~Buffer();

  VkBuffer handle() const { return handle_; }
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t address() const { return address_; }  // for kernels

  // The memory itself, of upload and readback buffers.
  template <class T>
  T* as() const {
    return static_cast<T*>(piece_.mapped());
  }

 private:
  Device* device_ = nullptr;
  VkBuffer handle_ = VK_NULL_HANDLE;
  MemoryPiece piece_;
  std::uint64_t bytes_ = 0, address_ = 0;
};

// Makes a buffer anew where it is shorter than that; its contents are undefined then.
Status grow(Device& device, Buffer& buffer, std::uint64_t bytes, BufferUse use);

}  // namespace luciole::gpu
