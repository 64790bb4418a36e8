// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/device_shading.h"

#include <algorithm>

#include "real_time/vulkan_transfer.h"

namespace luciole {
namespace {

constexpr const char* kPass = "culling_and_shading";

Status run(gpu::CommandList& list, PassTimes& times) {
  Status done = list.run();
  add_times(times, list.passes_ms());
  return done;
}

}  // namespace

Result<DeviceShading> DeviceShading::create(gpu::Device& device, const Settings& settings) {
  DeviceShading shading;
  if (settings.culling == Culling::clustered || settings.culling == Culling::splatting) {
    Result<ListShadingPass> lists = ListShadingPass::create(device, settings);
    if (!lists) return lists.error();
    shading.lists_ = std::move(*lists);
  } else {
    Result<TileShadingPass> tiles = TileShadingPass::create(device, settings, faster_light_reads(device.description()));
    if (!tiles) return tiles.error();
    shading.tiles_ = std::move(*tiles);
  }
  return shading;
}

Status DeviceShading::begin(gpu::Device& device, const FrameToShade& frame, std::uint32_t longest, PassTimes& times) {
  if (!lists_) return Done{};
  const Status reserved = lists_->reserve(device, frame.geometry.width, frame.geometry.height, longest);
  if (!reserved) return reserved;
  Result<gpu::CommandList> list = gpu::CommandList::create(device);
  if (!list) return list.error();
  list->begin_pass(kPass);
  lists_->record_parts(*list, *frame.pixels, frame.geometry);
  return luciole::run(*list, times);
}

Status DeviceShading::run(gpu::Device& device, LightKind kind, const ShadingBuffers& buffers, const FrameToShade& frame,
                          std::uint32_t lights, std::uint32_t part, PassTimes& times) const {
  for (std::uint32_t first = 0; first < lights; first += std::min(part, lights - first)) {
    Result<gpu::CommandList> list = gpu::CommandList::create(device);
    if (!list) return list.error();
    list->begin_pass(kPass);
    const LightPart now{first, std::min(part, lights - first)};
    if (lists_) {
      lists_->record(*list, kind, buffers, frame.geometry, frame.shift, now);
    } else {
      tiles_->record(*list, kind, buffers, frame.geometry, frame.shift, now);
    }
    if (Status done = luciole::run(*list, times); !done) return done;
  }
  return Done{};
}

void DeviceShading::unpack_counts(LightKind kind, const gpu::Buffer& counts, std::size_t tiles,
                                  ShadingOutputs& out) const {
  if (lists_) {
    LightCounts& to = kind == kDiffuseLights ? out.diffuse : kind == kGlossyLights ? out.glossy : out.many;
    const auto* parts = counts.as<PartCounts>();
    add_part_counts(parts, tiles, to, out.list_lengths);
    std::uint64_t pixels = 0;
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      for (const word_ of_part : parts[tile].pixels) pixels += of_part;
    }
    out.pixels = pixels;
  } else {
    unpack(kind, counts.as<TileCounts>(), tiles, out);
  }
}

}  // namespace luciole
