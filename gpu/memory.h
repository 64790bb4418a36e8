// SPDX-License-Identifier: Apache-2.0
// The one allocator: blocks of device memory per use, cut into buffers.
#pragma once
#include <vulkan/vulkan.h>

#include <memory>
#include <vector>

#include "base/result.h"
#include "gpu/free_list.h"

namespace luciole::gpu {

// What a buffer is for, which decides where it lies.
enum class BufferUse : std::uint8_t {
  device,     // kernels read and write it
  upload,     // the CPU writes it, a copy takes it to the device
  readback,   // a copy brings it from the device, the CPU reads it
  attachment  // no buffer but an image (image.h): in blocks of their own, as devices may keep the two apart
};

struct MemoryBlock;

// A piece of a block.
struct MemoryPiece {
  MemoryBlock* block = nullptr;
  std::uint64_t offset = 0, bytes = 0;
  VkDeviceMemory memory() const;
  void* mapped() const;  // of upload and readback; else null
};

class Memory {
 public:
  Memory(VkPhysicalDevice physical, VkDevice device);
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  Result<MemoryPiece> take(const VkMemoryRequirements& needs, BufferUse use);
  void give_back(const MemoryPiece& piece);  // a block without pieces goes back to the device

 private:
  Result<std::uint32_t> type_for(const VkMemoryRequirements& needs, BufferUse use) const;
  Result<MemoryBlock*> new_block(std::uint64_t bytes, std::uint32_t type, BufferUse use);

  VkDevice device_;
  VkPhysicalDeviceMemoryProperties properties_;
  std::vector<std::unique_ptr<MemoryBlock>> blocks_;
};

}  // namespace luciole::gpu
