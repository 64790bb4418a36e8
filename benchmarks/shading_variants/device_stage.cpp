// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/shading_variants/device_stage.h"

#include <algorithm>

#include "real_time/light_range/light_range.h"
#include "real_time/vulkan_transfer.h"

namespace luciole {
namespace {

constexpr std::uint32_t kSmallestTile = 8;  // pixels along its side: counts have room for as many
constexpr std::uint32_t kShift = 0;         // which subset a sub-region sees does not change what it costs

std::uint32_t longest(const SubsetLayout& layout) {
  return layout.count.empty() ? 0 : *std::max_element(layout.count.begin(), layout.count.end());
}

}  // namespace

Result<std::unique_ptr<DeviceStage>> DeviceStage::create(gpu::Device& device, const StageInputs& inputs) {
  std::unique_ptr<DeviceStage> stage(new DeviceStage(device, inputs));
  if (Status s = stage->send_frame(); !s) return s.error();
  Status sent =
      stage->send_lights<VplRecord>(inputs.vpls, {kDiffuseLights, kGlossyLights}, stage->vpls_, stage->vpl_subsets_);
  if (sent) {
    sent = stage->send_lights<ManyLightRecord>(inputs.many, {kManyLights}, stage->many_, stage->many_subsets_);
  }
  if (!sent) return sent.error();
  Result<DeviceLights> lights = stage->make_lights(inputs.settings);
  if (!lights) return lights.error();
  stage->lights_ = std::move(*lights);
  if (Status made = stage->make_outputs(); !made) return made.error();
  return stage;
}

Result<gpu::Buffer> DeviceStage::send(std::uint64_t bytes, const std::function<void(void*)>& pack) {
  Result<gpu::Buffer> buffer = gpu::Buffer::create(device_, bytes, gpu::BufferUse::device);
  if (!buffer) return buffer.error();
  Result<gpu::Buffer> staged = gpu::Buffer::create(device_, bytes, gpu::BufferUse::upload);
  if (!staged) return staged.error();
  pack(staged->as<void>());
  Result<gpu::CommandList> list = gpu::CommandList::create(device_);
  if (!list) return list.error();
  list->begin_pass("transfer");
  list->copy(*staged, *buffer, bytes);
  if (Status done = list->run(); !done) return done.error();
  return buffer;
}

// write(Record*) writes what is sent.
template <class Record, class Write>
Status DeviceStage::send_records(std::size_t count, const Write& write, gpu::Buffer& to) {
  if (count == 0) return Done{};
  Result<gpu::Buffer> sent = send(count * sizeof(Record), [&](void* memory) { write(static_cast<Record*>(memory)); });
  if (!sent) return sent.error();
  to = std::move(*sent);
  return Done{};
}

Status DeviceStage::send_frame() {
  const Settings& settings = inputs_.settings;
  const RangeParameters range = range_parameters(settings, inputs_.geometry.camera, {settings.seed, 0}, -1.0f);
  const auto pack_frame = [&](RangeFrame* to) { *to = range_frame(range, settings.interleave); };
  if (Status s = send_records<RangeFrame>(1, pack_frame, range_frame_); !s) return s;
  const auto pack_pixels = [&](PixelRecord* to) { pack(inputs_.geometry, to); };
  return send_records<PixelRecord>(inputs_.geometry.pixel_count(), pack_pixels, pixels_);
}

// The lights in the order of their subsets, and where those lie.
template <class Record, class Lights>
Status DeviceStage::send_lights(const Lights& lights, std::initializer_list<LightKind> kinds, gpu::Buffer& records,
                                gpu::Buffer& subsets) {
  const SubsetLayout layout = subset_layout(lights.key, inputs_.settings.interleave);
  for (const LightKind kind : kinds) {
    const bool wanted =
        kind == kManyLights || inputs_.settings.lobes != (kind == kDiffuseLights ? Lobes::glossy : Lobes::diffuse);
    entries_[kind] = wanted ? static_cast<std::uint32_t>(layout.light.size()) : 0;
    longest_[kind] = wanted ? longest(layout) : 0;
  }
  const auto pack_lights = [&](Record* to) { pack(lights, layout, to); };
  if (Status s = send_records<Record>(layout.light.size(), pack_lights, records); !s) return s;
  const auto pack_subsets = [&](SubsetRange* to) { pack(layout, to); };
  return send_records<SubsetRange>(layout.begin.size(), pack_subsets, subsets);
}

Result<DeviceLights> DeviceStage::make_lights(const Settings& settings) {
  Result<LightRangePass> ranges = LightRangePass::create(device_, settings);
  if (!ranges) return ranges.error();
  DeviceLights lights;
  for (const LightKind kind : kinds()) {
    LightsOnDevice& on = lights[kind];
    on.records = kind == kManyLights ? &many_ : &vpls_;
    on.entries = entries_[kind];
    const std::pair<gpu::Buffer*, std::uint64_t> buffers[] = {{&on.emitters, on.entries * kEmitterBytes[kind]},
                                                              {&on.bounds, on.entries / 16 * sizeof(BoundBlock)}};
    for (const auto& [buffer, bytes] : buffers) {
      Result<gpu::Buffer> made = gpu::Buffer::create(device_, bytes, gpu::BufferUse::device);
      if (!made) return made.error();
      *buffer = std::move(*made);
    }
  }
  Result<gpu::CommandList> list = gpu::CommandList::create(device_);
  if (!list) return list.error();
  ranges->record(*list, range_frame_, lights);
  if (Status done = list->run(); !done) return done.error();
  return lights;
}

Status DeviceStage::make_outputs() {
  const GeometryBuffer& geometry = inputs_.geometry;
  const std::uint32_t side = kSmallestTile * inputs_.settings.interleave;
  const std::uint64_t tiles = std::uint64_t((geometry.width + side - 1) / side) *
                              ((geometry.height + side - 1) / side) * inputs_.settings.interleave *
                              inputs_.settings.interleave;
  for (const LightKind kind : kinds()) {
    const std::pair<gpu::Buffer*, std::uint64_t> buffers[] = {
        {&sums_[kind], geometry.pixel_count() * sizeof(PixelSums)}, {&tile_counts_[kind], tiles * sizeof(TileCounts)}};
    for (const auto& [buffer, bytes] : buffers) {
      Result<gpu::Buffer> made = gpu::Buffer::create(device_, bytes, gpu::BufferUse::device);
      if (!made) return made.error();
      *buffer = std::move(*made);
    }
  }
  return Done{};
}

std::vector<LightKind> DeviceStage::kinds() const {
  std::vector<LightKind> there;
  for (const LightKind kind : {kDiffuseLights, kGlossyLights, kManyLights}) {
    if (longest_[kind] > 0) there.push_back(kind);
  }
  return there;
}

ShadingBuffers DeviceStage::buffers(LightKind kind, const DeviceLights& lights) const {
  return {&pixels_, kind == kManyLights ? &many_subsets_ : &vpl_subsets_, &lights[kind], &sums_[kind],
          &tile_counts_[kind]};
}

ShadingPush DeviceStage::push(LightKind kind) const {
  return shading_push(buffers(kind, lights_), inputs_.geometry, inputs_.settings.interleave, kShift,
                      {0, longest_[kind]});
}

Status DeviceStage::forget_sums() {
  Result<gpu::CommandList> list = gpu::CommandList::create(device_);
  if (!list) return list.error();
  list->begin_pass("transfer");
  constexpr std::uint32_t kNotANumber = 0x7fc00000u;
  for (const LightKind kind : kinds()) list->fill(sums_[kind], kNotANumber);
  return list->run();
}

template <class Record>
Result<std::vector<Record>> DeviceStage::read(const gpu::Buffer& buffer, std::size_t count) {
  const std::uint64_t bytes = count * sizeof(Record);
  Result<gpu::Buffer> received = gpu::Buffer::create(device_, bytes, gpu::BufferUse::readback);
  if (!received) return received.error();
  Result<gpu::CommandList> list = gpu::CommandList::create(device_);
  if (!list) return list.error();
  list->begin_pass("transfer");
  list->copy(buffer, *received, bytes);
  if (Status done = list->run(); !done) return done.error();
  const Record* records = received->as<Record>();
  return std::vector<Record>(records, records + count);
}

Result<std::vector<PixelSums>> DeviceStage::read_sums(LightKind kind) {
  return read<PixelSums>(sums_[kind], inputs_.geometry.pixel_count());
}

Result<std::vector<TileCounts>> DeviceStage::read_counts(LightKind kind) {
  const TileGrid grid = tile_grid(inputs_.geometry.width, inputs_.geometry.height, inputs_.settings.interleave);
  return read<TileCounts>(tile_counts_[kind], grid.count());
}

}  // namespace luciole
