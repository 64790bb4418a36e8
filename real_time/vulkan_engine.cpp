// SPDX-License-Identifier: Apache-2.0
#include "real_time/vulkan_engine.h"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "real_time/vulkan_transfer.h"

namespace luciole {
namespace {

// A frame on software Vulkan may not ask for more at once: there each invocation has 65,535 turns of loops in all, and
// for subgroups of four a light takes 3.25 at most: a quarter to be listed, one and a half to be added to each of the
// two halves (lights_by_subgroup.glsl). Of hardware, the longest submission that no operating system's watchdog minds.
constexpr std::uint32_t kSoftwarePart = 16384, kHardwarePart = 262144;
constexpr std::uint32_t kFewerWithShadows = 8;  // a shadow ray takes some dozens of turns

constexpr const char* kTransfer = "transfer";

std::uint32_t longest(const SubsetLayout& layout) {
  return layout.count.empty() ? 0 : *std::max_element(layout.count.begin(), layout.count.end());
}

void clear(Radiance& radiance, std::size_t pixels) {
  for (Plane3* planes : {&radiance.diffuse, &radiance.specular})
    for (Plane& plane : *planes) plane.assign(pixels, 0.0f);
}

// Software Vulkan traces rays on the CPU, many times slower than the CPU's own passes.
Result<Front> front_of(const Settings& settings, const gpu::DeviceDescription& device) {
  if (settings.front == Front::raster && !device.rasterises) {
    return Error{ErrorKind::failed, "the Vulkan device '" + device.name + "' cannot rasterise: use --front rays"};
  }
  if (settings.front != Front::automatic) return settings.front;
  if (device.kind == gpu::DeviceKind::cpu) return Front::cpu;
  return device.rasterises ? Front::raster : Front::rays;
}

// Whether the sums of pixels come back to the CPU.
bool wants_sums(const VulkanFrame& frame, bool filtered) {
  return !frame.compose && (!filtered || frame.noisy_too || frame.lobes_apart || frame.count_per_pixel);
}

}  // namespace

Result<std::unique_ptr<VulkanEngine>> VulkanEngine::create(const Settings& settings, const gpu::DeviceRequest& request,
                                                           std::uint32_t largest_part) {
  Result<std::unique_ptr<gpu::Device>> device = gpu::Device::create(request);
  if (!device) return device.error();
  std::unique_ptr<VulkanEngine> engine(new VulkanEngine(std::move(*device), settings));
  const bool software = engine->device().kind == gpu::DeviceKind::cpu;
  const std::uint32_t part =
      (software ? kSoftwarePart : kHardwarePart) / (settings.direct_shadows ? kFewerWithShadows : 1);
  engine->largest_part_ = largest_part > 0 ? largest_part : part;
  Result<LightRangePass> ranges = LightRangePass::create(*engine->device_, settings);
  if (!ranges) return ranges.error();
  Result<DeviceShading> shading = DeviceShading::create(*engine->device_, settings);
  if (!shading) return shading.error();
  engine->ranges_ = std::move(*ranges), engine->shading_ = std::move(*shading);
  const Result<Front> front_by = front_of(settings, engine->device());
  if (!front_by) return front_by.error();
  engine->settings_.front = *front_by;
  if (*front_by != Front::cpu) {
    Result<VulkanFront> front = VulkanFront::create(*engine->device_, engine->settings_);
    if (!front) return front.error();
    engine->front_ = std::move(*front);
  }
  Result<VulkanBack> back = VulkanBack::create(*engine->device_, settings);
  if (!back) return back.error();
  engine->back_ = std::move(*back);
  return engine;
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

Status VulkanEngine::send_scene(SceneToTrace scene) {
  if (scene_ && scene_number_ == scene.number) return Done{};
  scene_.reset();  // first, so that both need not fit
  const Result<Hierarchy> hierarchy = build_hierarchy(scene.rays->scene());
  if (!hierarchy) return hierarchy.error();
  Result<DeviceScene> sent = DeviceScene::create(*device_, scene.rays->scene(), *hierarchy);
  if (!sent) return sent.error();
  scene_.emplace(std::move(*sent)), scene_number_ = scene.number;
  return Done{};
}

Status VulkanEngine::make_view(std::uint64_t number, SceneToTrace scene, const ViewRequest& wanted) {
  if (number == view_) return Done{};
  view_ = ~std::uint64_t{0};
  if (Status sent = send_scene(scene); !sent) return sent;
  if (Status made = front_->render(*device_, *scene_, wanted, seen_); !made) return made;
  count_vpls();
  view_ = number;
  return Done{};
}

Status VulkanEngine::read_view(std::uint64_t number, SceneToTrace scene, const ViewRequest& wanted,
                               const ViewOnHost& to) {
  const auto start = std::chrono::steady_clock::now();
  const bool makes_view = number != view_;
  if (Status made = make_view(number, scene, wanted); !made) return made;
  if (Status read = read_back(*device_, seen_, wanted.view, to); !read) return read;
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  read_ms_ += wall.count() - (makes_view ? total_ms(front_->passes_ms()) : 0);
  return Done{};
}

Status VulkanEngine::send_view(const VulkanFrame& frame, gpu::CommandList& list) {
  if (frame.view == view_) return Done{};
  view_ = ~std::uint64_t{0};
  const auto pack_pixels = [&](PixelRecord* to) { pack(frame.geometry, to); };
  if (Status s = send<PixelRecord>(list, frame.geometry.pixel_count(), pack_pixels, seen_.geometry.pixels); !s) {
    return s;
  }
  const SubsetLayout layout = subset_layout(frame.vpls.key, settings_.interleave);
  const auto pack_lights = [&](VplRecord* to) { pack(frame.vpls, layout, to); };
  if (Status s = send<VplRecord>(list, layout.light.size(), pack_lights, seen_.vpls); !s) return s;
  const auto pack_subsets = [&](SubsetRange* to) { pack(layout, to); };
  if (Status s = send<SubsetRange>(list, layout.begin.size(), pack_subsets, seen_.subsets); !s) return s;
  seen_.entries = static_cast<std::uint32_t>(layout.light.size()), seen_.longest_subset = longest(layout);
  seen_.vpl_count = frame.vpls.size();
  count_vpls();
  view_ = frame.view;
  return Done{};
}

void VulkanEngine::count_vpls() {
  for (const LightKind kind : {kDiffuseLights, kGlossyLights}) {
    const bool wanted = settings_.lobes != (kind == kDiffuseLights ? Lobes::glossy : Lobes::diffuse);
    lights_[kind].entries = wanted ? seen_.entries : 0;
    lights_[kind].records = &seen_.vpls;
  }
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
                                                              {&tile_counts_[kind], tiles * shading_.count_bytes()}};
    for (const auto& [buffer, bytes] : buffers) {
      if (Status grown = grow(*buffer, bytes, gpu::BufferUse::device); !grown) return grown;
    }
  }
  if (wants_sums(frame, filters(frame))) {
    if (Status s = grow(received_pixels_, pixels * sizeof(PixelSums), gpu::BufferUse::readback); !s) return s;
  }
  return grow(received_counts_, tiles * shading_.count_bytes(), gpu::BufferUse::readback);
}

Status VulkanEngine::prepare(const VulkanFrame& frame, gpu::CommandList& list) {
  list.begin_pass(kTransfer);
  if (frame.made_here == nullptr) {
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

Status VulkanEngine::shade_lights(const VulkanFrame& frame) {
  const FrameToShade shared{&seen_.geometry.pixels, frame.geometry, frame.shift};
  const std::uint32_t longest = std::max(seen_.longest_subset, longest_subset_many_);
  Status done = shading_.begin(*device_, shared, longest, passes_ms_);
  if (done && settings_.direct_shadows) done = prepare_shadows(frame.scene);
  for (const LightKind kind : {kDiffuseLights, kGlossyLights, kManyLights}) {
    const bool many = kind == kManyLights;
    if (!done || lights_[kind].entries == 0) continue;
    const ShadingBuffers buffers{&seen_.geometry.pixels, many ? &many_subsets_ : &seen_.subsets,
                                 &lights_[kind],         &sums_[kind],
                                 &tile_counts_[kind],    settings_.direct_shadows ? &shadows_ : nullptr};
    const std::uint32_t lights = many ? longest_subset_many_ : seen_.longest_subset;
    done = shading_.run(*device_, kind, buffers, shared, lights, largest_part_, passes_ms_);
  }
  if (!done) view_ = ~std::uint64_t{0};
  return done;
}

Status VulkanEngine::prepare_shadows(SceneToTrace scene) {
  if (Status sent = send_scene(scene); !sent) return sent;
  if (Status grown = grow(unfinished_, sizeof(word_), gpu::BufferUse::device); !grown) return grown;
  Result<gpu::CommandList> list = gpu::CommandList::create(*device_);
  if (!list) return list.error();
  list->begin_pass(kTransfer);
  list->fill(unfinished_, 0);
  const auto pack = [&](ShadowRecord* to) {
    *to = {scene_->address(), unfinished_.address(), scene.rays->surface_offset(), 0};
  };
  Status done = send<ShadowRecord>(*list, 1, pack, shadows_);
  if (done) done = run(*list);
  sent_.clear();
  return done;
}

LightSums VulkanEngine::light_sums() const {
  LightSums sums;
  for (const LightKind kind : {kDiffuseLights, kGlossyLights}) {
    if (lights_[kind].entries > 0) sums.more_indirect = std::exchange(sums.indirect, &sums_[kind]);
  }
  if (lights_[kManyLights].entries > 0) sums.many = &sums_[kManyLights];
  return sums;
}

// What is to be done with the sums here.
Status VulkanEngine::finish(const VulkanFrame& frame, VulkanShaded& out) {
  Status done = Done{};
  if (frame.compose) {
    const BackInputs inputs{seen_, frame.view, frame.geometry, light_sums(), frame.shown};
    done = back_->compose(*device_, inputs, out.composed.emplace(), passes_ms_);
  } else if (filters(frame)) {
    const BackInputs inputs{seen_, frame.view, frame.geometry, light_sums(), {}};
    done = back_->filter(*device_, inputs, out.filtered.emplace(), passes_ms_);
  }
  if (!done) view_ = ~std::uint64_t{0};
  return done;
}

Status VulkanEngine::collect(const VulkanFrame& frame, ShadingOutputs& out) {
  if (settings_.direct_shadows) {
    const Result<std::vector<char>> unfinished = read(unfinished_, sizeof(word_));
    if (!unfinished) return unfinished.error();
    word_ rays = 0;
    std::memcpy(&rays, unfinished->data(), sizeof(word_));
    if (Status finished = all_finished(rays); !finished) return finished;
  }
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
    list->copy(tile_counts_[kind], received_counts_, tiles * shading_.count_bytes());
    if (Status done = run(*list); !done) return done;
    if (sums) unpack(frame.geometry, kind, received_pixels_.as<PixelSums>(), weight, out);
    shading_.unpack_counts(kind, received_counts_, tiles, out);
  }
  return Done{};
}

void VulkanEngine::clear_outputs(const VulkanFrame& frame, ShadingOutputs& out) const {
  const std::size_t pixels = frame.geometry.pixel_count();
  const bool noisy = !frame.compose && (!filters(frame) || frame.noisy_too);
  if (noisy) clear(out.radiance.indirect, pixels);
  if (noisy && frame.many.size() > 0) clear(out.radiance.from_many, pixels);
  if (frame.lobes_apart) clear(out.radiance.from_diffuse, pixels), clear(out.radiance.from_glossy, pixels);
  if (frame.count_per_pixel) out.lights_listed.assign(pixels, 0.0f), out.lights_false.assign(pixels, 0.0f);
}

Result<VulkanShaded> VulkanEngine::shade(const VulkanFrame& frame) {
  const bool makes_view = frame.made_here != nullptr && frame.view != view_;
  if (makes_view) {  // before the clock: to build and send the scene is no part of a frame
    if (Status sent = send_scene(frame.scene); !sent) return sent.error();
  }
  const auto start = std::chrono::steady_clock::now();
  passes_ms_ = {{"light_range", 0.0}, {"culling_and_shading", 0.0}};
  if (back_->has_filter() && frame.filter) passes_ms_.emplace_back("filtering", 0.0);
  if (frame.made_here != nullptr) {
    if (Status made = make_view(frame.view, frame.scene, *frame.made_here); !made) return made.error();
  }
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
  if (done) done = shade_lights(frame);
  if (done) done = finish(frame, result);
  if (done) done = collect(frame, result.shaded);
  if (!done) return done.error();
  // Whatever is not computing is transfer, also on this side.
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  if (frame.made_here != nullptr) result.passes_ms = front_->passes_ms();
  const double computing = total_ms(passes_ms_) - of_pass(passes_ms_, kTransfer);
  const double left = wall.count() - computing - (makes_view ? total_ms(front_->passes_ms()) : 0);
  for (const auto& [pass, ms] : passes_ms_) {
    if (pass != kTransfer) result.passes_ms.emplace_back(pass, ms);
  }
  result.passes_ms.emplace_back(kTransfer, std::max(0.0, left) + std::exchange(read_ms_, 0.0));
  result.vpl_count = seen_.vpl_count;
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
