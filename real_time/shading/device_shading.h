// SPDX-License-Identifier: Apache-2.0
// Passes culling and shading on a Vulkan device, whichever way lights are listed: by tiles (tile_shading_pass.h), or by
// clusters or splats (list_shading_pass.h).
#pragma once
#include <optional>

#include "real_time/pass_timer.h"
#include "real_time/shading/list_shading_pass.h"
#include "real_time/shading/tile_shading_pass.h"

namespace luciole {

// What all kinds of light of a frame share.
struct FrameToShade {
  const gpu::Buffer* pixels;       // PixelRecord
  const GeometryBuffer& geometry;  // size and camera
  std::uint32_t shift;             // as in ShadingInputs
};

class DeviceShading {
 public:
  static Result<DeviceShading> create(gpu::Device& device, const Settings& settings);

  std::size_t count_bytes() const { return lists_ ? sizeof(PartCounts) : sizeof(TileCounts); }  // of a tile

  // Memory for a frame, and what all kinds of light share.  longest: of the subsets of all kinds
  Status begin(gpu::Device& device, const FrameToShade& frame, std::uint32_t longest, PassTimes& times);
  // Lights of one kind, each part by itself: a long submission looks like a hung device to some systems.
  //   lights  of the longest subset
  //   part    lights of a subset that one submission asks
  Status run(gpu::Device& device, LightKind kind, const ShadingBuffers& buffers, const FrameToShade& frame,
             std::uint32_t lights, std::uint32_t part, PassTimes& times) const;

  // What one kind of light came to, from its counts of all tiles, which the CPU can read.
  void unpack_counts(LightKind kind, const gpu::Buffer& counts, std::size_t tiles, ShadingOutputs& out) const;

 private:
  std::optional<TileShadingPass> tiles_;
  std::optional<ListShadingPass> lists_;
};

}  // namespace luciole
