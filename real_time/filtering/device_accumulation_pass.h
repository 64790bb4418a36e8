// SPDX-License-Identifier: Apache-2.0
// Pass temporal accumulation on a Vulkan device: the kernel accumulate_light.comp. It makes what
// TemporalAccumulationPass (temporal_accumulation.h) makes, from the sums that shading left on the device.
#pragma once
#include <array>

#include "gpu/command_list.h"
#include "real_time/filtering/accumulation_records.h"
#include "real_time/filtering/past_view.h"

namespace luciole {

// What the kernel reads and writes of a frame; null: not there.
struct AccumulationBuffers {
  const gpu::Buffer* pixels;               // PixelRecord
  const gpu::Buffer* surfaces;             // SurfaceRecord
  const gpu::Buffer* sums = nullptr;       // PixelSums of indirect light
  const gpu::Buffer* more_sums = nullptr;  // to be added to these
  const gpu::Buffer* many_sums = nullptr;  // PixelSums of many lights
  const gpu::Buffer* frames = nullptr;     // float per pixel: TemporalAccumulationPass::frames()
  const gpu::Buffer* counts;               // AccumulationCounts
};

class DeviceAccumulationPass {
 public:
  //   interleave  n: the sums are weighted by n^2
  //   longest     frames that a mean may count, as in TemporalAccumulationPass::Inputs
  static Result<DeviceAccumulationPass> create(gpu::Device& device, std::uint32_t interleave, std::uint32_t longest);

  // The frame after the one that was recorded last. Fails where its history has no memory.
  //   view  has_many is taken from the buffers
  Status record(gpu::CommandList& list, const AccumulationBuffers& buffers, FrameView view);

  // The light of the frame that was recorded last, its weight 1 and 0 for the sky: PixelSums, for the filter and
  // composition. Null: no many lights.
  const gpu::Buffer* indirect() const { return &present().indirect; }
  const gpu::Buffer* many() const { return present().view.has_many ? &present().many : nullptr; }

  // Starts anew: the list that was recorded last has not run to its end.
  void forget();

 private:
  // What a frame leaves for the next.
  struct History {
    FrameView view;
    gpu::Buffer surfaces, indirect, many;
  };
  const History& present() const { return history_[now_]; }
  Status make_room(History& history, const FrameView& view);
  Status grow(gpu::Buffer& buffer, std::uint64_t bytes, gpu::BufferUse use);

  gpu::Device* device_ = nullptr;
  gpu::Kernel kernel_;
  float weight_ = 1, most_ = 0;
  std::array<History, 2> history_;
  std::size_t now_ = 0;
  gpu::Buffer sent_, frame_;  // AccumulationFrame
};

}  // namespace luciole
