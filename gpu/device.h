// SPDX-License-Identifier: Apache-2.0
// One Vulkan device, its queue and its memory. Outlives its buffers, kernels and command lists.
#pragma once
#include <vulkan/vulkan.h>

#include <memory>
#include <string>

#include "base/result.h"
#include "gpu/device_list.h"
#include "gpu/instance.h"
#include "gpu/memory.h"

namespace luciole::gpu {

struct DeviceRequest {
  std::string wanted;          // index, or part of the name; empty: the best there is
  bool hardware_only = false;  // no software on the CPU
  bool validation = false;     // with the validation layers
  bool in_kernels = true;      // which also check what kernels read and write (Instance::create)
  // For tests of what follows: this submission, counted from 1, and all later ones answer as a lost device does. 0:
  // none.
  std::uint32_t lost_from_submission = 0;
  bool may_rasterise = true;  // false, for tests: as a device that only computes
};

class Device {
 public:
  static Result<std::unique_ptr<Device>> create(const DeviceRequest& request);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceDescription& description() const { return description_; }
  VkDevice handle() const { return handle_; }
  std::uint32_t queue_family() const { return queue_family_; }
  double ns_per_tick() const { return static_cast<double>(limits_.timestampPeriod); }  // of timestamps
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  Memory& memory() { return *memory_; }

  // Runs a recorded command list and waits for its end.
  Status run(VkCommandBuffer commands);
  bool lost() const { return lost_; }  // nothing but its end helps

  // Failed if the validation layers had anything to say, with the first message.
  Status validated() const;

 private:
  Device() = default;
  Status open(VkPhysicalDevice physical);

  std::unique_ptr<Instance> instance_;
  DeviceDescription description_;
  VkDevice handle_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkFence finished_ = VK_NULL_HANDLE;
  std::uint32_t queue_family_ = 0;
  VkPhysicalDeviceLimits limits_{};
  std::unique_ptr<Memory> memory_;
  std::uint32_t submissions_ = 0, lost_from_submission_ = 0;
  bool lost_ = false;
};

}  // namespace luciole::gpu
