// SPDX-License-Identifier: Apache-2.0
#include "gpu/command_list.h"

#include "base/assert.h"
#include "gpu/vulkan_answer.h"

namespace luciole::gpu {

Result<CommandList> CommandList::create(Device& device) {
  CommandList list(device);
  if (Status opened = list.open(); !opened) return opened.error();
  return list;
}

Status CommandList::open() {
  const std::string attempt = "make a command list";
  auto pool = of_type<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  pool.queueFamilyIndex = device_->queue_family();
  if (Status s = checked(vkCreateCommandPool(device_->handle(), &pool, nullptr, &pool_), attempt); !s) return s;
  auto buffer = of_type<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  buffer.commandPool = pool_;
  buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  buffer.commandBufferCount = 1;
  if (Status s = checked(vkAllocateCommandBuffers(device_->handle(), &buffer, &commands_), attempt); !s) return s;
  auto times = of_type<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  times.queryType = VK_QUERY_TYPE_TIMESTAMP;
  times.queryCount = kMostPasses + 1;
  if (Status s = checked(vkCreateQueryPool(device_->handle(), &times, nullptr, &times_), attempt); !s) return s;
  auto begin = of_type<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  if (Status s = checked(vkBeginCommandBuffer(commands_, &begin), attempt); !s) return s;
  vkCmdResetQueryPool(commands_, times_, 0, kMostPasses + 1);
  return Done{};
}

void CommandList::stamp() { vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, times_, stamps_++); }

void CommandList::begin_pass(const std::string& name) {
  LUCIOLE_ASSERT_LT(stamps_, kMostPasses);
  barrier();
  stamp();
  passes_ms_.emplace_back(name, 0.0);
}

void CommandList::barrier() {
  LUCIOLE_ASSERT_EQ(rendering_, false);
  constexpr VkPipelineStageFlags2 kStages =
      VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  auto all = of_type<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  all.srcStageMask = kStages;
  all.srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;
  all.dstStageMask = kStages | VK_PIPELINE_STAGE_2_HOST_BIT;
  all.dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                      VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_READ_BIT;
  auto dependency = of_type<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &all;
  vkCmdPipelineBarrier2(commands_, &dependency);
}

void CommandList::record_dispatch(const Kernel& kernel, const void* push, std::size_t bytes, std::uint32_t x,
                                  std::uint32_t y, std::uint32_t z) {
  LUCIOLE_ASSERT_EQ(bytes, kernel.push_bytes());
  vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline());
  vkCmdPushConstants(commands_, kernel.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<std::uint32_t>(bytes),
                     push);
  vkCmdDispatch(commands_, x, y, z);
}

void CommandList::copy(const Buffer& from, const Buffer& to, std::uint64_t bytes) {
  if (bytes == 0) return;
  const VkBufferCopy whole{0, 0, bytes};
  vkCmdCopyBuffer(commands_, from.handle(), to.handle(), 1, &whole);
}

void CommandList::fill(const Buffer& buffer, std::uint32_t word) {
  vkCmdFillBuffer(commands_, buffer.handle(), 0, VK_WHOLE_SIZE, word);
}

Status CommandList::run() {
  barrier();
  stamp();
  if (Status s = checked(vkEndCommandBuffer(commands_), "end a command list"); !s) return s;
  if (Status s = device_->run(commands_); !s) return s;
  if (Status s = read_times(); !s) return s;
  return device_->validated();
}

Status CommandList::read_times() {
  std::vector<std::uint64_t> ticks(stamps_);
  const VkResult read = vkGetQueryPoolResults(device_->handle(), times_, 0, stamps_, 8 * ticks.size(), ticks.data(), 8,
                                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  if (read != VK_SUCCESS) return error_of(read, "read the times of the passes");
  for (std::size_t i = 0; i < passes_ms_.size(); ++i) {
    passes_ms_[i].second = static_cast<double>(ticks[i + 1] - ticks[i]) * device_->ns_per_tick() * 1e-6;
  }
  return Done{};
}

CommandList::CommandList(CommandList&& other) noexcept
    : device_(other.device_),
      pool_(std::exchange(other.pool_, VK_NULL_HANDLE)),
      commands_(other.commands_),
      times_(std::exchange(other.times_, VK_NULL_HANDLE)),
      stamps_(other.stamps_),
      rendering_(other.rendering_),
      passes_ms_(std::move(other.passes_ms_)) {}

CommandList::~CommandList() {
  vkDestroyQueryPool(device_->handle(), times_, nullptr);
  vkDestroyCommandPool(device_->handle(), pool_, nullptr);
}

}  // namespace luciole::gpu
