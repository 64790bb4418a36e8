// SPDX-License-Identifier: Apache-2.0
#include "gpu/memory.h"

#include <algorithm>

#include "gpu/vulkan_answer.h"

namespace luciole::gpu {

struct MemoryBlock {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
  std::uint32_t type = 0;
  BufferUse use = BufferUse::device;
  FreeList free;
};

namespace {

// Devices allow some thousand allocations in all, and each takes a while: small buffers share a block.
constexpr std::uint64_t kBlockBytes = std::uint64_t{32} << 20;

// Sets of properties to look for, the best first.
std::vector<VkMemoryPropertyFlags> preferences(BufferUse use) {
  constexpr VkMemoryPropertyFlags kSeen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (use) {
    case BufferUse::device:
    case BufferUse::attachment:
      return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    case BufferUse::readback:
      return {kSeen | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kSeen};
    default:
      return {kSeen};
  }
}

}  // namespace

VkDeviceMemory MemoryPiece::memory() const { return block->memory; }

void* MemoryPiece::mapped() const {
  return block->mapped == nullptr ? nullptr : static_cast<char*>(block->mapped) + offset;
}

Memory::Memory(VkPhysicalDevice physical, VkDevice device) : device_(device) {
  vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
}

Memory::~Memory() {
  for (const auto& block : blocks_) vkFreeMemory(device_, block->memory, nullptr);
}

Result<std::uint32_t> Memory::type_for(const VkMemoryRequirements& needs, BufferUse use) const {
  for (const VkMemoryPropertyFlags wanted : preferences(use)) {
    for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
      const bool fits = (needs.memoryTypeBits >> type & 1) != 0;
      if (fits && (properties_.memoryTypes[type].propertyFlags & wanted) == wanted) return type;
    }
  }
  return Error{ErrorKind::failed, "the Vulkan device has no memory that both it and the CPU see"};
}

Result<MemoryBlock*> Memory::new_block(std::uint64_t bytes, std::uint32_t type, BufferUse use) {
  auto block = std::make_unique<MemoryBlock>(MemoryBlock{VK_NULL_HANDLE, nullptr, type, use, FreeList(bytes)});
  auto addressed = of_type<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
  addressed.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  auto wanted = of_type<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  wanted.pNext = &addressed;
  wanted.allocationSize = bytes;
  wanted.memoryTypeIndex = type;
  const std::string attempt = "allocate " + std::to_string((bytes + 1048575) >> 20) + " MiB on the Vulkan device";
  if (Status made = checked(vkAllocateMemory(device_, &wanted, nullptr, &block->memory), attempt); !made) {
    return made.error();
  }
  blocks_.push_back(std::move(block));
  MemoryBlock& kept = *blocks_.back();
  if (use == BufferUse::upload || use == BufferUse::readback) {
    const VkResult mapped = vkMapMemory(device_, kept.memory, 0, VK_WHOLE_SIZE, 0, &kept.mapped);
    if (mapped != VK_SUCCESS) return error_of(mapped, "map memory of the Vulkan device");
  }
  return &kept;
}

Result<MemoryPiece> Memory::take(const VkMemoryRequirements& needs, BufferUse use) {
  const Result<std::uint32_t> type = type_for(needs, use);
  if (!type) return type.error();
  for (const auto& block : blocks_) {
    if (block->type != *type || block->use != use) continue;
    if (const auto offset = block->free.take(needs.size, needs.alignment)) {
      return MemoryPiece{block.get(), *offset, needs.size};
    }
  }
  const Result<MemoryBlock*> block = new_block(std::max<std::uint64_t>(needs.size, kBlockBytes), *type, use);
  if (!block) return block.error();
  return MemoryPiece{*block, *(*block)->free.take(needs.size, needs.alignment), needs.size};
}

void Memory::give_back(const MemoryPiece& piece) {
  piece.block->free.give_back(piece.offset, piece.bytes);
  if (!piece.block->free.unused()) return;
  vkFreeMemory(device_, piece.block->memory, nullptr);
  std::erase_if(blocks_, [&](const auto& block) { return block.get() == piece.block; });
}

}  // namespace luciole::gpu
