// SPDX-License-Identifier: Apache-2.0
#include "real_time/frame.h"

#include <algorithm>
#include <chrono>

#include "base/parallel.h"
#include "real_time/composition/composition.h"
#include "real_time/filtering/bilateral_filter.h"
#include "real_time/filtering/temporal_accumulation.h"
#include "real_time/light_range/clamped_range.h"
#include "real_time/light_range/light_range.h"
#include "real_time/light_statistics.h"
#include "real_time/many_lights/many_lights.h"
#include "real_time/not_finite.h"
#include "real_time/shading/prediction.h"
#include "real_time/shading/shading_pass.h"
#include "real_time/view.h"
#include "real_time/vulkan_recovery.h"

namespace luciole {
namespace {

const Error kInterrupted{ErrorKind::failed, "the frame was interrupted"};

bool wants(const std::vector<std::string>& layers, const std::string& name) {
  return std::find(layers.begin(), layers.end(), name) != layers.end();
}

bool wants_prediction(const std::vector<std::string>& layers) {
  return wants(layers, "reference") || wants(layers, "predicted_variance") || wants(layers, "predicted_accepted");
}

ShadingOutputs shade_on_cpu(const ShadingInputs& inputs, FrameStatistics& statistics) {
  const auto start = std::chrono::steady_clock::now();
  ShadingOutputs shaded = shade(inputs);
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  time_shading(shaded, wall.count(), statistics);
  return shaded;
}

void show(float exposure, ToneCurve curve, Frame& frame) {
  PassTimer timer(frame.statistics.passes_ms);
  frame.shown = srgb_codes(to_display(frame.picture, exposure, curve));
  timer.end("tone_curve");
}

}  // namespace

// What of a frame's light a device has made ready.
struct MadeOnDevice {
  std::optional<FilteredLight> filtered;
  std::optional<ComposedPicture> composed;
};

struct FrameWishes {
  const std::vector<std::string>& layers;
  std::optional<ToneCurve> shown;
};

struct Renderer::State {
  State(RayScene rays, const Camera& camera, PrimaryLights primaries, const Settings& settings_)
      : views(std::move(rays), camera, std::move(primaries), settings_), settings(settings_) {}

  // Whatever was kept of the view.
  void forget() {
    cached.reset();
    clamped.reset();
  }
  View* view(std::uint64_t frame_index);  // none after Ctrl-C
  bool needs_host(const std::vector<std::string>& layers) const;
  Status bring_to_host(std::uint64_t frame_index, View& seen, FrameStatistics& statistics);
  void give_up_device();
  float constant_xi(const View& seen, const ManyLights& many_lights);
  Result<ShadingOutputs> shade_lights(View& seen, std::uint64_t frame_index, const FrameWishes& wishes, Frame& frame,
                                      Prediction& prediction, MadeOnDevice& made);
  Result<std::optional<ShadingOutputs>> shade_on_device(const VulkanFrame& wanted, FrameStatistics& statistics,
                                                        MadeOnDevice& made);

  void finish(const View& seen, ShadingOutputs& shaded, const std::vector<std::string>& layers,
              const Prediction& prediction, const std::optional<FilteredLight>& on_device, Frame& frame);

  ViewMaker views;
  Settings settings;
  std::optional<VulkanRecovery> vulkan;  // none: the CPU engine
  double bvh_build_ms = 0;
  std::optional<View> cached;
  std::optional<float> clamped;  // xi of Ranges::clamped for this view
  TemporalAccumulationPass accumulation;
  BilateralFilterPass filter_indirect, filter_many;
};

View* Renderer::State::view(std::uint64_t frame_index) {
  if (!cached || settings.jitter) {
    cached.emplace();
    if (vulkan && vulkan->has_front()) {
      views.request(frame_index, *cached);
    } else if (!views.make(frame_index, *cached)) {
      cached.reset();
    }
  }
  return cached ? &*cached : nullptr;
}

// From then on this is the CPU engine.
void Renderer::State::give_up_device() {
  vulkan.reset();
  settings.engine = Engine::cpu;
  settings.device.clear();
}

// Whether the CPU looks at pixels or lights of the frame, and the device's view with them.
bool Renderer::State::needs_host(const std::vector<std::string>& layers) const {
  return !layers.empty() || settings.ranges == Ranges::clamped || settings.ranges == Ranges::clamped_bound;
}

// A view that only the device has is read back; if it is gone, the CPU makes it.
Status Renderer::State::bring_to_host(std::uint64_t frame_index, View& seen, FrameStatistics& statistics) {
  if (seen.on_host) return Done{};
  if (vulkan) {
    const ViewOnHost host{seen.geometry, seen.vpls, seen.direct};
    const auto read = vulkan->read_view(seen.number, views.scene_to_trace(), *seen.request, host, statistics.notes);
    if (!read) return read.error();
    seen.on_host = read->has_value();
    if (!seen.on_host) give_up_device();
  }
  if (!seen.on_host && !views.make(frame_index, seen)) return kInterrupted;
  return Done{};
}

// Lights of one frame that have their ranges. Lobes that are not wanted come to no list, and to no count.
struct Reached {
  ReachingLights<DiffuseEmitter> diffuse;
  ReachingLights<GlossyEmitter> glossy;
  ReachingLights<ManyEmitter> many;

  Reached(const View& seen, const ManyLights& many_lights, const RangeParameters& range, const Settings& settings)
      : diffuse(reach_diffuse_lobes(vpls_if(seen, settings.lobes != Lobes::glossy), range, settings.interleave,
                                    settings.isa)),
        glossy(reach_glossy_lobes(vpls_if(seen, settings.lobes != Lobes::diffuse), range, settings.interleave,
                                  settings.isa)),
        many(reach_many_lights(many_lights, range, settings.interleave, settings.isa)) {}

 private:
  static const VirtualPointLights& vpls_if(const View& seen, bool wanted) {
    static const VirtualPointLights none;
    return wanted ? seen.vpls : none;
  }
};

// The xi that all lights share; negative: each draws its own.
float Renderer::State::constant_xi(const View& seen, const ManyLights& many_lights) {
  switch (settings.ranges) {
    case Ranges::infinite:
      return 0.0f;
    case Ranges::clamped_bound:  // [TH16] Appendix A: r^2 = E N I / (pi eps) with delta = 2 pi eps is xi = 1 / (2 N)
      return 0.5f / static_cast<float>(std::max<std::size_t>(1, seen.vpls.size() + many_lights.size()));
    case Ranges::clamped: {
      if (clamped) return *clamped;
      // Of frame 0, whichever is rendered first: a frame alone is the same as in a sequence.
      const ManyLights of_first = make_many_lights(views.rays().scene(), views.primaries(), settings, 0);
      const Reached reached(seen, of_first, range_parameters(settings, views.camera(), {settings.seed, 0}, -1.0f),
                            settings);
      clamped = clamped_xi({seen.geometry, reached.diffuse, reached.glossy, reached.many, settings});
      return *clamped;
    }
    default:
      return -1.0f;
  }
}

// None where the device is gone for good.
Result<std::optional<ShadingOutputs>> Renderer::State::shade_on_device(const VulkanFrame& wanted,
                                                                       FrameStatistics& statistics,
                                                                       MadeOnDevice& made) {
  Result<std::optional<VulkanShaded>> shaded = vulkan->shade(wanted, statistics.notes);
  if (!shaded) return shaded.error();
  if (!*shaded) {
    give_up_device();
    return std::optional<ShadingOutputs>();
  }
  double shading_ms = 0;
  for (const auto& [pass, ms] : (*shaded)->passes_ms) {
    statistics.passes_ms.emplace_back(pass, ms);
    if (pass == "culling_and_shading") shading_ms = ms;
  }
  statistics.evaluations_per_second = listed_pairs((*shaded)->shaded) / std::max(shading_ms * 1e-3, 1e-9);
  statistics.virtual_point_lights = (*shaded)->vpl_count;
  made = {std::move((*shaded)->filtered), std::move((*shaded)->composed)};
  return std::optional<ShadingOutputs>(std::move((*shaded)->shaded));
}

Result<ShadingOutputs> Renderer::State::shade_lights(View& seen, std::uint64_t frame_index, const FrameWishes& wishes,
                                                     Frame& frame, Prediction& prediction, MadeOnDevice& made) {
  const std::vector<std::string>& layers = wishes.layers;
  if (!vulkan || needs_host(layers)) {
    if (Status there = bring_to_host(frame_index, seen, frame.statistics); !there) return there.error();
  }
  frame.statistics.passes_ms = seen.passes_ms;
  PassTimer timer(frame.statistics.passes_ms);
  const ManyLights many_lights = make_many_lights(views.rays().scene(), views.primaries(), settings, frame_index);
  timer.end("many_lights");
  frame.statistics.virtual_point_lights = seen.vpls.size();
  frame.statistics.many_lights = many_lights.size();
  const FrameKey key{settings.seed, frame_index};
  const RangeParameters range = range_parameters(settings, views.camera(), key, constant_xi(seen, many_lights));
  const std::uint32_t shift = subset_shift(key, settings.interleave);
  const bool count = wants(layers, "lights_listed") || wants(layers, "lights_false");
  const bool lobes_apart = wants(layers, "indirect_from_diffuse") || wants(layers, "indirect_from_glossy");
  std::optional<ShadingOutputs> shaded;
  if (vulkan) {
    const bool filter = settings.temporal <= 1;  // else the noisy light is accumulated first
    auto on_device =
        shade_on_device({seen.number, seen.geometry, seen.vpls, many_lights, range, shift, count, lobes_apart, filter,
                         /*noisy_too=*/wants(layers, "unfiltered"), seen.request ? &*seen.request : nullptr,
                         /*compose=*/!seen.on_host, views.scene_to_trace(), wishes.shown},
                        frame.statistics, made);
    if (!on_device) return on_device.error();
    shaded = std::move(*on_device);
    if (!shaded) {
      if (Status there = bring_to_host(frame_index, seen, frame.statistics); !there) return there.error();
      frame.statistics.virtual_point_lights = seen.vpls.size();
    }
  }
  frame.statistics.engine = to_string(settings.engine);
  if (!shaded || wants_prediction(layers)) {
    const Reached reached(seen, many_lights, range, settings);
    if (!shaded) timer.end("light_range");
    const ShadingInputs inputs{seen.geometry,
                               reached.diffuse,
                               reached.glossy,
                               reached.many,
                               settings,
                               shift,
                               settings.direct_shadows ? &views.rays() : nullptr,
                               count,
                               lobes_apart};
    if (!shaded) shaded = shade_on_cpu(inputs, frame.statistics);
    if (wants_prediction(layers)) prediction = predict(inputs);
  }
  count_lights(*shaded, frame.statistics);
  return std::move(*shaded);
}

// Accumulation, filter and composition by the CPU.
void Renderer::State::finish(const View& seen, ShadingOutputs& shaded, const std::vector<std::string>& layers,
                             const Prediction& prediction, const std::optional<FilteredLight>& on_device,
                             Frame& frame) {
  PassTimer timer(frame.statistics.passes_ms);
  std::uint64_t& bad = frame.statistics.pixels_not_finite;
  bad = std::max(count_not_finite(shaded.radiance.indirect), count_not_finite(shaded.radiance.from_many));
  if (on_device) bad = std::max(bad, on_device->not_finite);
  const bool accumulated = settings.temporal > 1;
  if (accumulated) {
    accumulation.run({seen.geometry, seen.number, settings.temporal}, shaded.radiance.indirect,
                     shaded.radiance.from_many);
    timer.end("temporal_accumulation");
  }
  const bool filtered = settings.filter == Filter::bilateral && !on_device;
  const Radiance& noisy = shaded.radiance.indirect;
  const BilateralFilterPass::Inputs common{seen.geometry, noisy, filter_radius(settings.interleave), settings.isa};
  BilateralFilterPass::Inputs for_many{seen.geometry, shaded.radiance.from_many, common.radius, common.isa};
  const Radiance& indirect = filtered ? filter_indirect.run(common) : on_device ? on_device->indirect : noisy;
  const Radiance& many = filtered    ? filter_many.run(for_many)
                         : on_device ? on_device->from_many
                                     : shaded.radiance.from_many;
  if (!on_device) timer.end("filtering");
  const Plane& history = accumulation.frames();
  compose({seen.geometry, seen.direct, indirect, many, shaded.radiance, shaded, history, prediction}, layers, frame);
  bad = std::max(bad, blacken_not_finite(frame.picture));
  timer.end("composition");
}

const std::vector<std::string>& Renderer::layer_names() { return composition_layers(); }

Status Renderer::check(const Settings& settings) {
  if (Result<Isa> isa = choose_isa(settings.isa); !isa) return isa.error();
  const bool asks_device = !settings.device.empty() || settings.vulkan_validation || settings.front != Front::automatic;
  if (settings.engine == Engine::cpu && asks_device) {
    return Error{ErrorKind::usage, "--device, --front and --vulkan-validation belong to --engine vulkan or auto"};
  }
  return Done{};
}

Result<Renderer> Renderer::create(std::shared_ptr<const Scene> scene, const Camera& camera, PrimaryLights primaries,
                                  const Settings& wanted) {
  if (Status able = check(wanted); !able) return able.error();
  Settings settings = wanted;
  settings.isa = *choose_isa(settings.isa);
  if (settings.ranges == Ranges::infinite) settings.culling = Culling::none;  // nothing can be culled
  Result<std::optional<VulkanRecovery>> vulkan = VulkanRecovery::chosen_by(settings);
  if (!vulkan) return vulkan.error();
  const auto start = std::chrono::steady_clock::now();
  Result<RayScene> rays = RayScene::create(std::move(scene), {.isa = to_string(settings.isa)});
  if (!rays) return rays.error();
  auto state = std::make_unique<State>(std::move(*rays), camera, std::move(primaries), settings);
  state->vulkan = std::move(*vulkan);
  state->bvh_build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return Renderer(std::move(state));
}

Result<Frame> Renderer::render(std::uint64_t frame_index, const std::vector<std::string>& layers,
                               std::optional<ToneCurve> shown) {
  Frame frame;
  frame.width = state_->settings.width, frame.height = state_->settings.height;
  View* view = state_->view(frame_index);
  if (view == nullptr) return kInterrupted;
  View& seen = *view;
  Prediction prediction;
  MadeOnDevice made;
  Result<ShadingOutputs> lit = state_->shade_lights(seen, frame_index, {layers, shown}, frame, prediction, made);
  if (stop_requested()) return kInterrupted;
  if (!lit) return lit.error();
  if (made.composed) {
    frame.picture = std::move(made.composed->picture), frame.shown = std::move(made.composed->shown);
    frame.layers.width = frame.width, frame.layers.height = frame.height;
    frame.statistics.pixels_not_finite = made.composed->not_finite;
  } else {
    state_->finish(seen, *lit, layers, prediction, made.filtered, frame);
    if (shown) show(state_->settings.exposure, *shown, frame);
  }
  for (const auto& [pass, ms] : frame.statistics.passes_ms) frame.statistics.frame_ms += ms;
  if (stop_requested()) return kInterrupted;
  return frame;
}

void Renderer::set_camera(const Camera& camera) {
  if (state_->views.set_camera(camera)) state_->forget();
}

Status Renderer::set_scene(std::shared_ptr<const Scene> scene, PrimaryLights primaries) {
  const auto start = std::chrono::steady_clock::now();
  Result<RayScene> rays = RayScene::create(std::move(scene), {.isa = to_string(state_->settings.isa)});
  if (!rays) return rays.error();
  state_->views.set_scene(std::move(*rays), std::move(primaries));
  state_->bvh_build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  state_->forget();
  return Done{};
}

const Settings& Renderer::settings() const { return state_->settings; }
double Renderer::bvh_build_ms() const { return state_->bvh_build_ms; }

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

}  // namespace luciole
