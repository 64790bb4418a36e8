// SPDX-License-Identifier: Apache-2.0
#include "real_time/vulkan_back.h"

#include <algorithm>
#include <cstring>

#include "real_time/filtering/bilateral_filter.h"
#include "real_time/vulkan_transfer.h"

namespace luciole {
namespace {

constexpr const char* kTransfer = "transfer";
constexpr std::uint64_t kCodeBytes = 4;  // of a pixel: red, green, blue, 255

Status run(gpu::CommandList& list, PassTimes& times) {
  Status done = list.run();
  add_times(times, list.passes_ms());
  return done;
}

std::uint64_t pixels_of(const BackInputs& inputs) { return std::uint64_t(inputs.screen.width) * inputs.screen.height; }

std::vector<std::uint8_t> without_alpha(const std::uint8_t* codes, std::uint64_t pixels) {
  std::vector<std::uint8_t> colours(3 * pixels);
  for (std::uint64_t i = 0; i < pixels; ++i) std::memcpy(&colours[3 * i], codes + kCodeBytes * i, 3);
  return colours;
}

}  // namespace

Result<VulkanBack> VulkanBack::create(gpu::Device& device, const Settings& settings) {
  VulkanBack back;
  back.weight_ = static_cast<float>(settings.interleave * settings.interleave);
  back.exposure_ = settings.exposure;
  Result<DeviceCompositionPass> composition = DeviceCompositionPass::create(device);
  if (!composition) return composition.error();
  Result<DeviceToneCurvePass> tone_curve = DeviceToneCurvePass::create(device);
  if (!tone_curve) return tone_curve.error();
  back.composition_ = std::move(*composition), back.tone_curve_ = std::move(*tone_curve);
  if (settings.temporal > 1) {
    Result<DeviceAccumulationPass> made =
        DeviceAccumulationPass::create(device, settings.interleave, settings.temporal);
    if (!made) return made.error();
    back.accumulation_ = std::move(*made);
  }
  if (settings.filter == Filter::bilateral) {
    const FilterRadius radius = filter_radius(settings.interleave);
    Result<DeviceFilterPass> filter = DeviceFilterPass::create(device, radius, settings.interleave);
    if (!filter) return filter.error();
    back.filter_ = std::move(*filter);
  }
  const std::pair<gpu::Buffer*, std::uint64_t> counts[] = {
      {&back.received_filter_counts_[kIndirect], sizeof(FilterCounts)},
      {&back.received_filter_counts_[kMany], sizeof(FilterCounts)},
      {&back.received_accumulation_counts_, sizeof(AccumulationCounts)},
      {&back.received_composition_counts_, sizeof(CompositionCounts)}};
  for (const auto& [buffer, bytes] : counts) {
    if (Status grown = gpu::grow(device, *buffer, bytes, gpu::BufferUse::readback); !grown) return grown.error();
  }
  return back;
}

// From here on the sums are means that have their weight.
Status VulkanBack::record_accumulation(gpu::Device& device, gpu::CommandList& list, BackInputs& inputs) {
  const Status grown = gpu::grow(device, accumulation_counts_, sizeof(AccumulationCounts), gpu::BufferUse::device);
  if (!grown) return grown;
  list.begin_pass("temporal_accumulation");
  AccumulationBuffers buffers{};
  buffers.pixels = &inputs.seen.geometry.pixels, buffers.surfaces = &inputs.seen.geometry.surfaces;
  buffers.sums = inputs.sums.indirect, buffers.more_sums = inputs.sums.more_indirect;
  buffers.many_sums = inputs.sums.many, buffers.counts = &accumulation_counts_;
  const GeometryBuffer& screen = inputs.screen;
  const FrameView view{screen.camera, screen.sub_pixel_x, screen.sub_pixel_y, screen.width, screen.height, inputs.view};
  if (Status recorded = accumulation_->record(list, buffers, view); !recorded) return recorded;
  inputs.sums = {inputs.sums.indirect != nullptr ? accumulation_->indirect() : nullptr, nullptr, accumulation_->many()};
  return Done{};
}

Status VulkanBack::record_filter(gpu::Device& device, gpu::CommandList& list, const BackInputs& inputs, bool weighed) {
  list.begin_pass("filtering");
  for (const Source source : {kIndirect, kMany}) {
    FilterBuffers buffers{};
    buffers.pixels = &inputs.seen.geometry.pixels, buffers.weighed = weighed;
    buffers.sums = source == kIndirect ? inputs.sums.indirect : inputs.sums.many;
    buffers.more_sums = source == kIndirect ? inputs.sums.more_indirect : nullptr;
    if (buffers.sums == nullptr) continue;
    const std::uint64_t bytes = pixels_of(inputs) * sizeof(PixelLight);
    Status grown = gpu::grow(device, filtered_[source], bytes, gpu::BufferUse::device);
    if (grown) grown = gpu::grow(device, filter_counts_[source], sizeof(FilterCounts), gpu::BufferUse::device);
    if (!grown) return grown;
    buffers.filtered = &filtered_[source], buffers.counts = &filter_counts_[source];
    filter_->record(list, buffers, inputs.screen);
  }
  return Done{};
}

Status VulkanBack::filter(gpu::Device& device, const BackInputs& inputs, FilteredLight& out, PassTimes& times) {
  const std::size_t pixels = pixels_of(inputs);
  Result<gpu::CommandList> list = gpu::CommandList::create(device);
  if (!list) return list.error();
  if (Status recorded = record_filter(device, *list, inputs, false); !recorded) return recorded;
  if (Status done = run(*list, times); !done) return done;
  for (Plane3* planes : {&out.indirect.diffuse, &out.indirect.specular}) {
    for (Plane& plane : *planes) plane.assign(pixels, 0.0f);
  }
  const Status grown = gpu::grow(device, received_, pixels * sizeof(PixelLight), gpu::BufferUse::readback);
  if (!grown) return grown;
  const std::pair<const gpu::Buffer*, Radiance*> sources[] = {{inputs.sums.indirect, &out.indirect},
                                                              {inputs.sums.many, &out.from_many}};
  for (const Source source : {kIndirect, kMany}) {
    if (sources[source].first == nullptr) continue;
    Result<gpu::CommandList> back = gpu::CommandList::create(device);
    if (!back) return back.error();
    back->begin_pass(kTransfer);
    back->copy(filtered_[source], received_, pixels * sizeof(PixelLight));
    const gpu::Buffer& counts = received_filter_counts_[source];
    back->copy(filter_counts_[source], counts, sizeof(FilterCounts));
    if (Status done = run(*back, times); !done) return done;
    unpack(received_.as<PixelLight>(), pixels, *sources[source].second);
    out.not_finite = std::max<std::uint64_t>(out.not_finite, counts.as<FilterCounts>()->not_finite);
  }
  return Done{};
}

Status VulkanBack::record_composition(gpu::Device& device, gpu::CommandList& list, BackInputs inputs) {
  const bool accumulated = accumulation_.has_value();
  if (accumulated) {
    if (Status recorded = record_accumulation(device, list, inputs); !recorded) return recorded;
  }
  CompositionBuffers parts{};
  parts.pixels = &inputs.seen.geometry.pixels, parts.surfaces = &inputs.seen.geometry.surfaces;
  parts.direct = &inputs.seen.direct, parts.picture = &picture_, parts.counts = &composition_counts_;
  if (filter_) {
    if (Status recorded = record_filter(device, list, inputs, accumulated); !recorded) return recorded;
    parts.indirect = inputs.sums.indirect != nullptr ? &filtered_[kIndirect] : nullptr;
    parts.many = inputs.sums.many != nullptr ? &filtered_[kMany] : nullptr;
  } else {
    parts.sums = inputs.sums.indirect, parts.more_sums = inputs.sums.more_indirect;
    parts.many_sums = inputs.sums.many;
    parts.weight = accumulated ? 1.0f : weight_;
  }
  list.begin_pass("composition");
  composition_.record(list, parts, inputs.screen.width, inputs.screen.height);
  if (inputs.shown) {
    if (Status recorded = record_tone_curve(device, list, inputs); !recorded) return recorded;
  }
  list.begin_pass(kTransfer);
  list.copy(picture_, received_, pixels_of(inputs) * sizeof(PixelColour));
  if (inputs.shown) list.copy(codes_, received_codes_, pixels_of(inputs) * kCodeBytes);
  list.copy(composition_counts_, received_composition_counts_, sizeof(CompositionCounts));
  if (accumulated) list.copy(accumulation_counts_, received_accumulation_counts_, sizeof(AccumulationCounts));
  if (parts.indirect != nullptr) {
    list.copy(filter_counts_[kIndirect], received_filter_counts_[kIndirect], sizeof(FilterCounts));
  }
  if (parts.many != nullptr) list.copy(filter_counts_[kMany], received_filter_counts_[kMany], sizeof(FilterCounts));
  return Done{};
}

Status VulkanBack::record_tone_curve(gpu::Device& device, gpu::CommandList& list, const BackInputs& inputs) {
  const std::uint64_t bytes = pixels_of(inputs) * kCodeBytes;
  Status grown = gpu::grow(device, codes_, bytes, gpu::BufferUse::device);
  if (grown) grown = gpu::grow(device, received_codes_, bytes, gpu::BufferUse::readback);
  if (!grown) return grown;
  list.begin_pass("tone_curve");
  tone_curve_.record(list, picture_, codes_, inputs.screen.width, inputs.screen.height, exposure_, *inputs.shown);
  return Done{};
}

Status VulkanBack::compose(gpu::Device& device, const BackInputs& inputs, ComposedPicture& out, PassTimes& times) {
  static_assert(sizeof(PixelColour) == sizeof(Vec3));
  const std::uint64_t bytes = pixels_of(inputs) * sizeof(PixelColour);
  Status grown = gpu::grow(device, picture_, bytes, gpu::BufferUse::device);
  if (grown) grown = gpu::grow(device, composition_counts_, sizeof(CompositionCounts), gpu::BufferUse::device);
  if (grown) grown = gpu::grow(device, received_, bytes, gpu::BufferUse::readback);
  if (!grown) return grown;
  for (const gpu::Buffer& counts : received_filter_counts_) *counts.as<FilterCounts>() = {};
  *received_accumulation_counts_.as<AccumulationCounts>() = {};
  Result<gpu::CommandList> list = gpu::CommandList::create(device);
  if (!list) return list.error();
  Status done = record_composition(device, *list, inputs);
  if (done) done = run(*list, times);
  if (!done) {
    if (accumulation_) accumulation_->forget();
    return done;
  }
  const auto* colours = received_.as<Vec3>();
  out.picture.assign(colours, colours + pixels_of(inputs));
  if (inputs.shown) out.shown = without_alpha(received_codes_.as<std::uint8_t>(), pixels_of(inputs));
  const auto& accumulation = *received_accumulation_counts_.as<AccumulationCounts>();
  out.not_finite = std::max<std::uint64_t>({accumulation.not_finite, accumulation.many_not_finite,
                                            received_composition_counts_.as<CompositionCounts>()->not_finite});
  for (const gpu::Buffer& counts : received_filter_counts_) {
    out.not_finite = std::max<std::uint64_t>(out.not_finite, counts.as<FilterCounts>()->not_finite);
  }
  return Done{};
}

}  // namespace luciole
