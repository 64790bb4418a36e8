// SPDX-License-Identifier: Apache-2.0
// Work for the device, recorded in order, then run and waited for. Each pass is timed by the device's own clock.
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "gpu/raster_pipeline.h"

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

  // What is drawn from here on, until end_rendering(), goes into these images; only draws may come between. The images
  // are cleared: `colour` to the two words, `depth` to 0, which is infinitely far away.
  //   width, height  of what is drawn: the images' first columns and rows
  void begin_rendering(const Image& colour, const Image& depth, std::uint32_t width, std::uint32_t height,
                       const std::array<std::uint32_t, 2>& clear);
  // A VkDrawIndirectCommand each, `count` of them from number `first` on. A push as for dispatch().
  template <class Push>
  void draw(const RasterPipeline& pipeline, const Push& push, const Buffer& commands, std::uint32_t first,
            std::uint32_t count) {
    record_draw(pipeline, &push, sizeof(Push), commands, first, count);
  }
  // From here on kernels and copies may overwrite what the draws read, and `colour`, the same, can be copied.
  void end_rendering(const Image& colour);
  // The first columns and rows of what was drawn last, rows one after the other.
  void copy(const Image& from, const Buffer& to, std::uint32_t width, std::uint32_t height);

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
  void record_draw(const RasterPipeline& pipeline, const void* push, std::size_t bytes, const Buffer& commands,
                   std::uint32_t first, std::uint32_t count);

  Device* device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkQueryPool times_ = VK_NULL_HANDLE;
  std::uint32_t stamps_ = 0;
  bool rendering_ = false;
  std::vector<std::pair<std::string, double>> passes_ms_;
};

}  // namespace luciole::gpu
