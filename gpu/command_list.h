// SPDX-License-Identifier: Apache-2.0
// Work for the device, recorded in order, then run and waited for. Each pass is timed by the device's own clock.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/kernel.h"

namespace luciole::gpu {

class CommandList {
 public:
  static Result<CommandList> create(Device& device);
  CommandList(CommandList&& other) noexcept;
  CommandList& operator=(CommandList&&) = delete;
  ~CommandList();

  // From here on commands belong to this pass. All that earlier passes wrote can be read.
  void begin_pass(const std::string& name);

  //   push    a plain struct of kernel.push_bytes() bytes
  //   groups  number of workgroups
  template <class Push>
  void dispatch(const Kernel& kernel, const Push& push, std::uint32_t groups_x, std::uint32_t groups_y = 1,
                std::uint32_t groups_z = 1) {
    record_dispatch(kernel, &push, sizeof(Push), groups_x, groups_y, groups_z);
  }
  void copy(const Buffer& from, const Buffer& to, std::uint64_t bytes);
  void fill(const Buffer& buffer, std::uint32_t word);
  void barrier();  // what was written before can be read, and written again, after

  // Ends the recording; runs it; waits. A list runs once.
  Status run();

  // After run(): each pass by name, in order.
  const std::vector<std::pair<std::string, double>>& passes_ms() const { return passes_ms_; }

 private:
  static constexpr std::uint32_t kMostPasses = 32;
  explicit CommandList(Device& device) : device_(&device) {}
  Status open();
  Status read_times();
  void stamp();
  void record_dispatch(const Kernel& kernel, const void* push, std::size_t bytes, std::uint32_t x, std::uint32_t y,
                       std::uint32_t z);

  Device* device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkQueryPool times_ = VK_NULL_HANDLE;
  std::uint32_t stamps_ = 0;
  std::vector<std::pair<std::string, double>> passes_ms_;
};

}  // namespace luciole::gpu
