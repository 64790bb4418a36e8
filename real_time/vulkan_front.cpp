// SPDX-License-Identifier: Apache-2.0
#include "real_time/vulkan_front.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "real_time/device_scene/upload.h"
#include "real_time/direct_light/direct_sources.h"
#include "real_time/vulkan_transfer.h"

namespace luciole {
namespace {

template <class Pass>
Status take(Result<Pass> made, Pass& to) {
  if (!made) return made.error();
  to = std::move(*made);
  return Done{};
}

// Copies of a device's buffers that the CPU can read, in one submission.
class Download {
 public:
  explicit Download(gpu::Device& device) : device_(&device) {}

  Status run(const std::vector<std::pair<const gpu::Buffer*, std::uint64_t>>& wanted) {
    Result<gpu::CommandList> list = gpu::CommandList::create(*device_);
    if (!list) return list.error();
    list->begin_pass("transfer");
    for (const auto& [from, bytes] : wanted) {
      Result<gpu::Buffer> one = gpu::Buffer::create(*device_, bytes, gpu::BufferUse::readback);
      if (!one) return one.error();
      list->copy(*from, *one, bytes);
      received_.push_back(std::move(*one));
    }
    return list->run();
  }
  template <class T>
  const T* values(std::size_t which) const {
    return received_[which].as<T>();
  }

 private:
  gpu::Device* device_;
  std::vector<gpu::Buffer> received_;
};

void unpack(const float* from, Plane3& to) {
  parallel_for(to[0].size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t c = 0; c < 3; ++c) to[c][i] = from[3 * i + c];
    }
  });
}

}  // namespace

Result<VulkanFront> VulkanFront::create(gpu::Device& device, const Settings& settings) {
  VulkanFront front;
  front.subsets_ = settings.interleave * settings.interleave;
  if (settings.front == Front::rays) {
    Result<DeviceGeometryPass> traced = DeviceGeometryPass::create(device);
    if (!traced) return traced.error();
    front.traced_ = std::move(*traced);
  }
  Status made = take(DeviceLightMapPass::create(device, settings.interleave), front.light_maps_);
  if (made) made = take(DevicePlacementPass::create(device, settings.interleave), front.placement_);
  if (made) made = take(DeviceDirectLightPass::create(device), front.direct_);
  if (!made) return made.error();
  return front;
}

Status VulkanFront::prepare_geometry(gpu::Device& device, const DeviceScene& scene, const DeviceView& view) {
  if (traced_ || (rasterised_ && scene.mesh_count() <= most_meshes_)) return Done{};
  rasterised_.reset();
  Result<RasterGeometryPass> made = RasterGeometryPass::create(device, view.width, view.height, scene.mesh_count());
  if (!made) return made.error();
  rasterised_.emplace(std::move(*made)), most_meshes_ = scene.mesh_count();
  return Done{};
}

// Memory, and what is sent.
Status VulkanFront::prepare(gpu::Device& device, const ViewRequest& wanted, ViewOnDevice& made) {
  if (!maps_ || maps_number_ != wanted.maps_number) {
    Result<LightMapsOnDevice> sent = LightMapsOnDevice::create(device, *wanted.maps);
    if (!sent) return sent.error();
    maps_.emplace(std::move(*sent)), maps_number_ = wanted.maps_number;
  }
  Result<Upload> upload = Upload::begin(device);
  if (!upload) return upload.error();
  const std::vector<DirectSource> sources = direct_sources(direct_lights(wanted.rays->scene(), wanted.lights));
  source_count_ = static_cast<std::uint32_t>(sources.size());
  if (Status sent = upload->add(sources, sources_); !sent) return sent;
  if (Status sent = upload->finish(); !sent) return sent;
  const std::uint64_t pixels = std::uint64_t(wanted.view.width) * wanted.view.height, texels = maps_->texel_count();
  const std::pair<gpu::Buffer*, std::uint64_t> buffers[] = {
      {&made.geometry.pixels, pixels * sizeof(PixelRecord)},
      {&made.geometry.surfaces, pixels * sizeof(SurfaceRecord)},
      {&made.geometry.unfinished, sizeof(word_)},
      {&made.direct, pixels * 3 * sizeof(float)},
      {&texels_.lights, texels * sizeof(VplRecord)},
      {&texels_.counts, subsets_ * sizeof(word_)},
      {&made.vpls, placement_.most_entries(maps_->texel_count()) * sizeof(VplRecord)},
      {&made.subsets, subsets_ * sizeof(SubsetRange)}};
  for (const auto& [buffer, bytes] : buffers) {
    if (Status grown = gpu::grow(device, *buffer, bytes, gpu::BufferUse::device); !grown) return grown;
  }
  return Done{};
}

Status VulkanFront::run(gpu::Device& device, const DeviceScene& scene, const ViewRequest& wanted, ViewOnDevice& made) {
  Result<gpu::CommandList> list = gpu::CommandList::create(device);
  if (!list) return list.error();
  if (traced_) {
    traced_->record(*list, scene, wanted.view, made.geometry);
  } else {
    rasterised_->record(*list, scene, wanted.view, made.geometry);
  }
  const gpu::Buffer& unfinished = made.geometry.unfinished;
  light_maps_.record(*list, scene, *maps_, wanted.sampling, texels_, unfinished);
  placement_.record(*list, texels_.lights, texels_.counts, maps_->texel_count(), {&made.vpls, &made.subsets});
  direct_.record(*list, {scene, wanted.rays->surface_offset(), wanted.view, made.geometry, sources_, source_count_},
                 made.direct, unfinished);
  Status done = list->run();
  passes_ms_ = list->passes_ms();
  return done;
}

Status VulkanFront::read_counts(gpu::Device& device, ViewOnDevice& made) const {
  Download counts(device);
  const Status read =
      counts.run({{&made.subsets, subsets_ * sizeof(SubsetRange)}, {&made.geometry.unfinished, sizeof(word_)}});
  if (!read) return read;
  if (Status finished = all_finished(*counts.values<word_>(1)); !finished) return finished;
  const auto* ranges = counts.values<SubsetRange>(0);
  made.vpl_count = 0, made.longest_subset = 0;
  for (std::uint32_t s = 0; s < subsets_; ++s) {
    made.vpl_count += ranges[s].count;
    made.longest_subset = std::max(made.longest_subset, ranges[s].count);
  }
  const SubsetRange last = ranges[subsets_ - 1];
  made.entries = last.begin + (last.count + 15) / 16 * 16;
  return Done{};
}

Status VulkanFront::render(gpu::Device& device, const DeviceScene& scene, const ViewRequest& wanted,
                           ViewOnDevice& made) {
  if (Status done = prepare_geometry(device, scene, wanted.view); !done) return done;
  if (Status done = prepare(device, wanted, made); !done) return done;
  if (Status done = run(device, scene, wanted, made); !done) return done;
  return read_counts(device, made);
}

Status read_back(gpu::Device& device, const ViewOnDevice& from, const DeviceView& view, const ViewOnHost& to) {
  if (Status done = read_back(device, from.geometry, view, to.geometry); !done) return done;
  Download rest(device);
  const std::size_t pixels = to.geometry.pixel_count();
  const Status read =
      rest.run({{&from.direct, pixels * 3 * sizeof(float)}, {&from.vpls, from.entries * sizeof(VplRecord)}});
  if (!read) return read;
  for (Plane& plane : to.direct) plane.resize(pixels);
  unpack(rest.values<float>(0), to.direct);
  unpack(rest.values<VplRecord>(1), from.entries, to.vpls);
  return Done{};
}

}  // namespace luciole
