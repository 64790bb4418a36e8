// SPDX-License-Identifier: Apache-2.0
#include "real_time/vulkan_engine.h"

#include <algorithm>
#include <chrono>

#include "real_time/filtering/bilateral_filter.h"
#include "real_time/vulkan_transfer.h"

namespace luciole {
namespace {

// A frame on software Vulkan may not ask for more at once: there each invocation has 65,535 turns of loops in all, and
// a light takes one, and a quarter of one for subgroups of four. Of hardware, the longest submission that no watchdog
// of an operating system minds.
constexpr std::uint32_t kSoftwarePart = 32768, kHardwarePart = 262144;

constexpr const char* kTransfer = "transfer";

std::uint32_t longest(const SubsetLayout& layout) {
  return layout.count.empty() ? 0 : *std::max_element(layout.count.begin(), layout.count.end());
}

void add_times(std::vector<std::pair<std::string, double>>& sums,
               const std::vector<std::pair<std::string, double>>& more) {
  for (const auto& [name, ms] : more) {
    const auto known =
        std::find_if(sums.begin(), sums.end(), [&, &wanted = name](const auto& sum) { return sum.first == wanted; });
    if (known == sums.end()) {
      sums.emplace_back(name, ms);
    } else {
      known->second += ms;
    }
  }
}

void clear(Radiance& radiance, std::size_t pixels) {
  for (Plane3* planes : {&radiance.diffuse, &radiance.specular})
    for (Plane& plane : *planes) plane.assign(pixels, 0.0f);
}

// Whether the sums of pixels come back to the CPU.
bool wants_sums(const VulkanFrame& frame, bool filtered) {
  return !filtered || frame.noisy_too || frame.lobes_apart || frame.count_per_pixel;
}

}  // namespace

Status VulkanEngine::can_do(const Settings& settings) {
  const auto refused = [](const std::string& setting) {
    return Error{ErrorKind::usage, "the Vulkan engine cannot do " + setting + ": use --engine cpu"};
  };
  if (settings.direct_shadows) return refused("--direct-shadows");
  if (settings.culling == Culling::clustered || settings.culling == Culling::splatting) {
    return refused("--culling " + to_string(settings.culling));
  }
  return Done{};
}

Result<std::unique_ptr<VulkanEngine>> VulkanEngine::create(const Settings& settings, const gpu::DeviceRequest& request,
                                                           std::uint32_t largest_part) {
  if (Status able = can_do(settings); !able) return able.error();
  Result<std::unique_ptr<gpu::Device>> device = gpu::Device::create(request);
  if (!device) return device.error();
  std::unique_ptr<VulkanEngine> engine(new VulkanEngine(std::move(*device), settings));
  const bool software = engine->device().kind == gpu::DeviceKind::cpu;
  engine->largest_part_ = largest_part > 0 ? largest_part : software ? kSoftwarePart : kHardwarePart;
  Result<LightRangePass> ranges = LightRangePass::create(*engine->device_, settings);
  if (!ranges) return ranges.error();
  Result<TileShadingPass> shading = TileShadingPass::create(*engine->device_, settings);
  if (!shading) return shading.error();
  engine->ranges_ = std::move(*ranges), engine->shading_ = std::move(*shading);
  if (settings.filter == Filter::bilateral) {
    const FilterRadius radius = filter_radius(settings.interleave);
    Result<DeviceFilterPass> filter = DeviceFilterPass::create(*engine->device_, radius, settings.interleave);
    if (!filter) return filter.error();
    engine->filter_ = std::move(*filter);
  }
  return engine;
}

Status VulkanEngine::grow(gpu::Buffer& buffer, std::uint64_t bytes, gpu::BufferUse use) {
  if (buffer.bytes() >= bytes && buffer.bytes() > 0) return Done{};
  buffer = gpu::Buffer();  // first, so that both need not fit
  Result<gpu::Buffer> larger = gpu::Buffer::create(*device_, bytes, use);
  if (!larger) return larger.error();
  buffer = std::move(*larger);
  return Done{};
}

// pack(Record*) writes what is sent.
template <class Record, class Pack>
Status VulkanEngine::send(gpu::CommandList& list, std::size_t count, const Pack& pack, gpu::Buffer& to) {
  const std::uint64_t bytes = count * sizeof(Record);
  if (Status grown = grow(to, bytes, gpu::BufferUse::device); !grown) return grown;
  Result<gpu::Buffer> staged = gpu::Buffer::create(*device_, bytes, gpu::BufferUse::upload);
  if (!staged) return staged.error();
  pack(staged->template as<Record>());
  list.copy(*staged, to, bytes);
  sent_.push_back(std::move(*staged));
  return Done{};
}

Status VulkanEngine::send_view(const VulkanFrame& frame, gpu::CommandList& list) {
  const auto pack_pixels = [&](PixelRecord* to) { pack(frame.geometry, to); };
  if (Status s = send<PixelRecord>(list, frame.geometry.pixel_count(), pack_pixels, pixels_); !s) return s;
  const SubsetLayout layout = subset_layout(frame.vpls.key, settings_.interleave);
  longest_subset_vpls_ = longest(layout);
  const auto pack_lights = [&](VplRecord* to) { pack(frame.vpls, layout, to); };
  if (Status s = send<VplRecord>(list, layout.light.size(), pack_lights, vpls_); !s) return s;
  const auto pack_subsets = [&](SubsetRange* to) { pack(layout, to); };
  if (Status s = send<SubsetRange>(list, layout.begin.size(), pack_subsets, vpl_subsets_); !s) return s;
  for (const LightKind kind : {kDiffuseLights, kGlossyLights}) {
    const bool wanted = settings_.lobes != (kind == kDiffuseLights ? Lobes::glossy : Lobes::diffuse);
    lights_[kind].entries = wanted ? static_cast<std::uint32_t>(layout.light.size()) : 0;
    lights_[kind].records = &vpls_;
  }
  view_ = frame.view;
  return Done{};
}

Status VulkanEngine::send_many_lights(const VulkanFrame& frame, gpu::CommandList& list) {
  const SubsetLayout layout = subset_layout(frame.many.key, settings_.interleave);
  longest_subset_many_ = longest(layout);
  lights_[kManyLights].entries = static_cast<std::uint32_t>(layout.light.size());
  lights_[kManyLights].records = &many_;
  if (layout.light.empty()) return Done{};
  const auto pack_lights = [&](ManyLightRecord* to) { pack(frame.many, layout, to); };
  if (Status s = send<ManyLightRecord>(list, layout.light.size(), pack_lights, many_); !s) return s;
  const auto pack_subsets = [&](SubsetRange* to) { pack(layout, to); };
  return send<SubsetRange>(list, layout.begin.size(), pack_subsets, many_subsets_);
}

Status VulkanEngine::make_outputs(const VulkanFrame& frame) {
  const std::size_t pixels = frame.geometry.pixel_count();
  const std::size_t tiles = tile_grid(frame.geometry.width, frame.geometry.height, settings_.interleave).count();
  for (std::size_t kind = 0; kind < kLightKinds; ++kind) {
    LightsOnDevice& on = lights_[kind];
    if (on.entries == 0) continue;
    const std::pair<gpu::Buffer*, std::uint64_t> buffers[] = {{&on.emitters, on.entries * kEmitterBytes[kind]},
                                                              {&on.bounds, on.entries / 16 * sizeof(BoundBlock)},
                                                              {&sums_[kind], pixels * sizeof(PixelSums)},
                                                              {&tile_counts_[kind], tiles * sizeof(TileCounts)}};
    for (const auto& [buffer, bytes] : buffers) {
      if (Status grown = grow(*buffer, bytes, gpu::BufferUse::device); !grown) return grown;
    }
  }
  if (filters(frame)) {
    if (Status s = grow(filtered_, pixels * sizeof(PixelLight), gpu::BufferUse::device); !s) return s;
    if (Status s = grow(filter_counts_, sizeof(FilterCounts), gpu::BufferUse::device); !s) return s;
  }
  const std::size_t of_pixel = wants_sums(frame, filters(frame)) ? sizeof(PixelSums) : sizeof(PixelLight);
  if (Status s = grow(received_pixels_, pixels * of_pixel, gpu::BufferUse::readback); !s) return s;
  return grow(received_counts_, tiles * sizeof(TileCounts), gpu::BufferUse::readback);
}

Status VulkanEngine::prepare(const VulkanFrame& frame, gpu::CommandList& list) {
  list.begin_pass(kTransfer);
  if (frame.view != view_) {
    view_ = ~std::uint64_t{0};
    if (Status sent = send_view(frame, list); !sent) return sent;
  }
  if (Status sent = send_many_lights(frame, list); !sent) return sent;
  const auto pack_frame = [&](RangeFrame* to) { *to = range_frame(frame.range, settings_.interleave); };
  if (Status sent = send<RangeFrame>(list, 1, pack_frame, range_frame_); !sent) return sent;
  return make_outputs(frame);
}

Status VulkanEngine::run(gpu::CommandList& list) {
  Status done = list.run();
  if (!done) view_ = ~std::uint64_t{0};
  add_times(passes_ms_, list.passes_ms());
  return done;
}

// Each part by itself: a long submission looks like a hung device to some systems.
Status VulkanEngine::run_parts(const VulkanFrame& frame) {
  for (const LightKind kind : {kDiffuseLights, kGlossyLights, kManyLights}) {
    const bool many = kind == kManyLights;
    if (lights_[kind].entries == 0) continue;
    const std::uint32_t lights = many ? longest_subset_many_ : longest_subset_vpls_;
    const ShadingBuffers buffers{&pixels_, many ? &many_subsets_ : &vpl_subsets_, &lights_[kind], &sums_[kind],
                                 &tile_counts_[kind]};
    for (std::uint64_t first = 0; first < lights; first += largest_part_) {
      Result<gpu::CommandList> list = gpu::CommandList::create(*device_);
      if (!list) return list.error();
      list->begin_pass("culling_and_shading");
      shading_.record(*list, kind, buffers, frame.geometry, frame.shift,
                      {static_cast<std::uint32_t>(first), largest_part_});
      if (Status done = run(*list); !done) return done;
    }
  }
  return Done{};
}

// Of one kind of light, or of two together. `light` is a part of `out`.
Status VulkanEngine::filter_sums(const GeometryBuffer& geometry, std::initializer_list<LightKind> kinds,
                                 FilteredLight& out, Radiance& light) {
  const std::size_t pixels = geometry.pixel_count();
  FilterBuffers buffers{&pixels_, nullptr, nullptr, &filtered_, &filter_counts_};
  for (const LightKind kind : kinds) {
    if (lights_[kind].entries > 0) buffers.more_sums = std::exchange(buffers.sums, &sums_[kind]);
  }
  if (buffers.sums == nullptr) return Done{};
  Result<gpu::CommandList> list = gpu::CommandList::create(*device_);
  if (!list) return list.error();
  list->begin_pass("filtering");
  filter_->record(*list, buffers, geometry);
  list->begin_pass(kTransfer);
  list->copy(filtered_, received_pixels_, pixels * sizeof(PixelLight));
  list->copy(filter_counts_, received_counts_, sizeof(FilterCounts));
  if (Status done = run(*list); !done) return done;
  unpack(received_pixels_.as<PixelLight>(), pixels, light);
  out.not_finite = std::max<std::uint64_t>(out.not_finite, received_counts_.as<FilterCounts>()->not_finite);
  return Done{};
}

Status VulkanEngine::filter(const VulkanFrame& frame, FilteredLight& out) {
  clear(out.indirect, frame.geometry.pixel_count());
  if (Status done = filter_sums(frame.geometry, {kDiffuseLights, kGlossyLights}, out, out.indirect); !done) return done;
  return filter_sums(frame.geometry, {kManyLights}, out, out.from_many);
}

Status VulkanEngine::collect(const VulkanFrame& frame, ShadingOutputs& out) {
  const std::size_t pixels = frame.geometry.pixel_count();
  const std::size_t tiles = tile_grid(frame.geometry.width, frame.geometry.height, settings_.interleave).count();
  const float weight = static_cast<float>(settings_.interleave * settings_.interleave);
  const bool sums = wants_sums(frame, filters(frame));
  for (const LightKind kind : {kDiffuseLights, kGlossyLights, kManyLights}) {
    if (lights_[kind].entries == 0) continue;
    Result<gpu::CommandList> list = gpu::CommandList::create(*device_);
    if (!list) return list.error();
    list->begin_pass(kTransfer);
    if (sums) list->copy(sums_[kind], received_pixels_, pixels * sizeof(PixelSums));
    list->copy(tile_counts_[kind], received_counts_, tiles * sizeof(TileCounts));
    if (Status done = run(*list); !done) return done;
    if (sums) unpack(frame.geometry, kind, received_pixels_.as<PixelSums>(), weight, out);
    unpack(kind, received_counts_.as<TileCounts>(), tiles, out);
  }
  return Done{};
}

void VulkanEngine::clear_outputs(const VulkanFrame& frame, ShadingOutputs& out) const {
  const std::size_t pixels = frame.geometry.pixel_count();
  const bool noisy = !filters(frame) || frame.noisy_too;
  if (noisy) clear(out.radiance.indirect, pixels);
  if (noisy && frame.many.size() > 0) clear(out.radiance.from_many, pixels);
  if (frame.lobes_apart) clear(out.radiance.from_diffuse, pixels), clear(out.radiance.from_glossy, pixels);
  if (frame.count_per_pixel) out.lights_listed.assign(pixels, 0.0f), out.lights_false.assign(pixels, 0.0f);
  out.pixels = static_cast<std::uint64_t>(std::count_if(frame.geometry.depth.begin(), frame.geometry.depth.end(),
                                                        [](float depth) { return depth != kNoSurface; }));
}

Result<VulkanShaded> VulkanEngine::shade(const VulkanFrame& frame) {
  const auto start = std::chrono::steady_clock::now();
  passes_ms_ = {{"light_range", 0.0}, {"culling_and_shading", 0.0}};
  if (filters(frame)) passes_ms_.emplace_back("filtering", 0.0);
  VulkanShaded result;
  clear_outputs(frame, result.shaded);
  Result<gpu::CommandList> list = gpu::CommandList::create(*device_);
  if (!list) return list.error();
  Status done = prepare(frame, *list);
  if (done) {
    ranges_.record(*list, range_frame_, lights_);
    done = run(*list);
  }
  sent_.clear();
  if (done) done = run_parts(frame);
  if (done && filters(frame)) done = filter(frame, result.filtered.emplace());
  if (done) done = collect(frame, result.shaded);
  if (!done) return done.error();
  // Whatever is not computing is transfer, also on this side.
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  double left = wall.count();
  for (const auto& [pass, ms] : passes_ms_) {
    if (pass == kTransfer) continue;
    result.passes_ms.emplace_back(pass, ms);
    left -= ms;
  }
  result.passes_ms.emplace_back(kTransfer, std::max(0.0, left));
  return result;
}

Result<std::vector<char>> VulkanEngine::read(const gpu::Buffer& buffer, std::uint64_t bytes) {
  Result<gpu::Buffer> received = gpu::Buffer::create(*device_, bytes, gpu::BufferUse::readback);
  if (!received) return received.error();
  Result<gpu::CommandList> list = gpu::CommandList::create(*device_);
  if (!list) return list.error();
  list->begin_pass(kTransfer);
  list->copy(buffer, *received, bytes);
  if (Status done = list->run(); !done) return done.error();
  return std::vector<char>(received->as<char>(), received->as<char>() + bytes);
}

Result<std::vector<char>> VulkanEngine::read_emitters(LightKind kind) {
  return read(lights_[kind].emitters, lights_[kind].entries * kEmitterBytes[kind]);
}

Result<std::vector<char>> VulkanEngine::read_bounds(LightKind kind) {
  return read(lights_[kind].bounds, lights_[kind].entries / 16 * sizeof(BoundBlock));
}

}  // namespace luciole
