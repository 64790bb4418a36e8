// SPDX-License-Identifier: Apache-2.0
#include "real_time/frame.h"

#include <algorithm>
#include <chrono>

#include "base/parallel.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/composition/composition.h"
#include "real_time/direct_light/direct_light.h"
#include "real_time/filtering/bilateral_filter.h"
#include "real_time/filtering/temporal_accumulation.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "real_time/light_range/clamped_range.h"
#include "real_time/light_range/light_range.h"
#include "real_time/light_statistics.h"
#include "real_time/many_lights/many_lights.h"
#include "real_time/not_finite.h"
#include "real_time/shading/prediction.h"
#include "real_time/shading/shading_pass.h"
#include "real_time/sky_light/sky_light.h"
#include "real_time/virtual_point_lights/place_lights.h"
#include "real_time/vulkan_recovery.h"

namespace luciole {
namespace {

class PassTimer {
 public:
  explicit PassTimer(FrameStatistics& statistics) : statistics_(statistics) {}
  // The time since the last call (or construction) belongs to this pass.
  void end(const std::string& pass) {
    const auto now = std::chrono::steady_clock::now();
    statistics_.passes_ms.emplace_back(pass, std::chrono::duration<double, std::milli>(now - last_).count());
    last_ = now;
  }

 private:
  FrameStatistics& statistics_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

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

bool is_same_view(const Camera& a, const Camera& b) {
  const auto same = [](Vec3 u, Vec3 v) { return u.x == v.x && u.y == v.y && u.z == v.z; };
  return same(a.eye, b.eye) && same(a.right, b.right) && same(a.up, b.up) && same(a.forward, b.forward) &&
         a.vertical_fov == b.vertical_fov;
}

}  // namespace

// What frames of an unmoved camera and unmoved lights have in common.
struct View {
  std::uint64_t number = 0;  // of its rendering, from 1
  GeometryBuffer geometry;
  VirtualPointLights vpls;
  Plane3 direct;
  std::vector<std::pair<std::string, double>> passes_ms;

  const VirtualPointLights& vpls_if(bool wanted) const {
    static const VirtualPointLights none;
    return wanted ? vpls : none;
  }
};

struct Renderer::State {
  State(RayScene scene, const Camera& camera_, PrimaryLights primaries_, const Settings& settings_)
      : rays(std::move(scene)), camera(camera_), primaries(std::move(primaries_)), settings(settings_) {}

  // Whatever was kept of the scene and of the view.
  void forget() {
    cached.reset();
    maps.reset();
    clamped.reset();
  }
  const View* view(std::uint64_t frame_index);  // none after Ctrl-C
  bool render_view(std::uint64_t frame_index, View& made);
  float constant_xi(const View& seen, const ManyLights& many_lights);
  Result<ShadingOutputs> shade_lights(const View& seen, std::uint64_t frame_index,
                                      const std::vector<std::string>& layers, Frame& frame, Prediction& prediction,
                                      std::optional<FilteredLight>& filtered);
  Result<std::optional<ShadingOutputs>> shade_on_device(const VulkanFrame& wanted, FrameStatistics& statistics,
                                                        std::optional<FilteredLight>& filtered);

  RayScene rays;
  Camera camera;
  PrimaryLights primaries;
  Settings settings;
  std::optional<VulkanRecovery> vulkan;  // none: the CPU engine
  double bvh_build_ms = 0;
  std::uint64_t views = 0;  // rendered so far
  std::optional<View> cached;
  std::optional<ReflectiveShadowMaps> maps;  // kept, as the order of their texels takes a while to find
  std::optional<float> clamped;              // xi of Ranges::clamped for this view
  TemporalAccumulationPass accumulation;
  BilateralFilterPass filter_indirect, filter_many;
};

const View* Renderer::State::view(std::uint64_t frame_index) {
  if (!cached || settings.jitter) {
    cached.emplace();
    if (!render_view(frame_index, *cached)) cached.reset();
  }
  return cached ? &*cached : nullptr;
}

// False where it was asked to stop: no pass takes a second, all of them may.
bool Renderer::State::render_view(std::uint64_t frame_index, View& made) {
  FrameStatistics times;
  PassTimer timer(times);
  const Vec2 sub_pixel = settings.jitter ? jittered_sub_pixel(settings.vpl_seed, frame_index) : Vec2(0.5f, 0.5f);
  render_geometry_buffer({rays, camera, settings.width, settings.height, sub_pixel, settings.isa}, made.geometry);
  timer.end("geometry_buffer");
  if (stop_requested()) return false;
  PrimaryLights lights = primaries;
  const PrimaryLights sky = sample_sky(rays.scene().environment,
                                       {.seed = settings.vpl_seed, .frame = frame_index, .jitter = settings.jitter});
  lights.insert(lights.end(), sky.begin(), sky.end());
  timer.end("sky_light");
  const bool lights_move = settings.jitter && !sky.empty();
  if (!maps || lights_move) maps.emplace(lights, rays.bounds(), settings.vpls);
  std::vector<SurfaceTexel> texels;
  maps->render(rays, {settings.vpl_seed, settings.jitter, frame_index}, texels);
  timer.end("reflective_shadow_map");
  if (stop_requested()) return false;
  place_virtual_point_lights(texels, made.vpls);
  timer.end("virtual_point_lights");
  made.direct = direct_light(rays, made.geometry, lights, settings.isa);
  timer.end("direct_light");
  made.passes_ms = times.passes_ms;
  made.number = ++views;
  return !stop_requested();
}

// Lights of one frame that have their ranges. Lobes that are not wanted come to no list, and to no count.
struct Reached {
  ReachingLights<DiffuseEmitter> diffuse;
  ReachingLights<GlossyEmitter> glossy;
  ReachingLights<ManyEmitter> many;

  Reached(const View& seen, const ManyLights& many_lights, const RangeParameters& range, const Settings& settings)
      : diffuse(reach_diffuse_lobes(seen.vpls_if(settings.lobes != Lobes::glossy), range, settings.interleave,
                                    settings.isa)),
        glossy(reach_glossy_lobes(seen.vpls_if(settings.lobes != Lobes::diffuse), range, settings.interleave,
                                  settings.isa)),
        many(reach_many_lights(many_lights, range, settings.interleave, settings.isa)) {}
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
      const ManyLights of_first = make_many_lights(rays.scene(), primaries, settings, 0);
      const Reached reached(seen, of_first, range_parameters(settings, camera, {settings.seed, 0}, -1.0f), settings);
      clamped = clamped_xi({seen.geometry, reached.diffuse, reached.glossy, reached.many, settings});
      return *clamped;
    }
    default:
      return -1.0f;
  }
}

// None where the device is gone for good: from then on this is the CPU engine.
Result<std::optional<ShadingOutputs>> Renderer::State::shade_on_device(const VulkanFrame& wanted,
                                                                       FrameStatistics& statistics,
                                                                       std::optional<FilteredLight>& filtered) {
  Result<std::optional<VulkanShaded>> shaded = vulkan->shade(wanted, statistics.notes);
  if (!shaded) return shaded.error();
  if (!*shaded) {
    vulkan.reset();
    settings.engine = Engine::cpu;
    settings.device.clear();
    return std::optional<ShadingOutputs>();
  }
  double shading_ms = 0;
  for (const auto& [pass, ms] : (*shaded)->passes_ms) {
    statistics.passes_ms.emplace_back(pass, ms);
    if (pass == "culling_and_shading") shading_ms = ms;
  }
  statistics.evaluations_per_second = listed_pairs((*shaded)->shaded) / std::max(shading_ms * 1e-3, 1e-9);
  filtered = std::move((*shaded)->filtered);
  return std::optional<ShadingOutputs>(std::move((*shaded)->shaded));
}

Result<ShadingOutputs> Renderer::State::shade_lights(const View& seen, std::uint64_t frame_index,
                                                     const std::vector<std::string>& layers, Frame& frame,
                                                     Prediction& prediction, std::optional<FilteredLight>& filtered) {
  frame.statistics.passes_ms = seen.passes_ms;
  PassTimer timer(frame.statistics);
  const ManyLights many_lights = make_many_lights(rays.scene(), primaries, settings, frame_index);
  timer.end("many_lights");
  frame.statistics.virtual_point_lights = seen.vpls.size();
  frame.statistics.many_lights = many_lights.size();
  const FrameKey key{settings.seed, frame_index};
  const RangeParameters range = range_parameters(settings, camera, key, constant_xi(seen, many_lights));
  const std::uint32_t shift = subset_shift(key, settings.interleave);
  const bool count = wants(layers, "lights_listed") || wants(layers, "lights_false");
  const bool lobes_apart = wants(layers, "indirect_from_diffuse") || wants(layers, "indirect_from_glossy");
  std::optional<ShadingOutputs> shaded;
  if (vulkan) {
    const bool filter = settings.temporal <= 1;  // else the noisy light is accumulated first
    auto on_device = shade_on_device({seen.number, seen.geometry, seen.vpls, many_lights, range, shift, count,
                                      lobes_apart, filter, /*noisy_too=*/wants(layers, "unfiltered")},
                                     frame.statistics, filtered);
    if (!on_device) return on_device.error();
    shaded = std::move(*on_device);
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
                               settings.direct_shadows ? &rays : nullptr,
                               count,
                               lobes_apart};
    if (!shaded) shaded = shade_on_cpu(inputs, frame.statistics);
    if (wants_prediction(layers)) prediction = predict(inputs);
  }
  count_lights(*shaded, frame.statistics);
  return std::move(*shaded);
}

const std::vector<std::string>& Renderer::layer_names() { return composition_layers(); }

Status Renderer::check(const Settings& settings) {
  if (Result<Isa> isa = choose_isa(settings.isa); !isa) return isa.error();
  if (settings.engine == Engine::vulkan) return VulkanEngine::can_do(settings);
  if (settings.engine == Engine::cpu && (!settings.device.empty() || settings.vulkan_validation)) {
    return Error{ErrorKind::usage, "--device and --vulkan-validation belong to --engine vulkan or auto"};
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

Result<Frame> Renderer::render(std::uint64_t frame_index, const std::vector<std::string>& layers) {
  Frame frame;
  frame.width = state_->settings.width, frame.height = state_->settings.height;
  const Error stopped{ErrorKind::failed, "the frame was interrupted"};
  const View* view = state_->view(frame_index);
  if (view == nullptr) return stopped;
  const View& seen = *view;
  Prediction prediction;
  std::optional<FilteredLight> on_device;  // what needs no filter here
  Result<ShadingOutputs> lit = state_->shade_lights(seen, frame_index, layers, frame, prediction, on_device);
  if (stop_requested()) return stopped;
  if (!lit) return lit.error();
  ShadingOutputs& shaded = *lit;
  PassTimer timer(frame.statistics);
  std::uint64_t& bad = frame.statistics.pixels_not_finite;
  bad = std::max(count_not_finite(shaded.radiance.indirect), count_not_finite(shaded.radiance.from_many));
  if (on_device) bad = std::max(bad, on_device->not_finite);
  const bool accumulated = state_->settings.temporal > 1;
  if (accumulated) {
    state_->accumulation.run({seen.geometry, seen.number, state_->settings.temporal}, shaded.radiance.indirect,
                             shaded.radiance.from_many);
    timer.end("temporal_accumulation");
  }
  const bool filtered = state_->settings.filter == Filter::bilateral && !on_device;
  const Radiance& noisy = shaded.radiance.indirect;
  const BilateralFilterPass::Inputs common{seen.geometry, noisy, filter_radius(state_->settings.interleave),
                                           state_->settings.isa};
  BilateralFilterPass::Inputs for_many{seen.geometry, shaded.radiance.from_many, common.radius, common.isa};
  const Radiance& indirect = filtered ? state_->filter_indirect.run(common) : on_device ? on_device->indirect : noisy;
  const Radiance& many = filtered    ? state_->filter_many.run(for_many)
                         : on_device ? on_device->from_many
                                     : shaded.radiance.from_many;
  if (!on_device) timer.end("filtering");
  const Plane& history = state_->accumulation.frames();
  compose({seen.geometry, seen.direct, indirect, many, shaded.radiance, shaded, history, prediction}, layers, frame);
  bad = std::max(bad, blacken_not_finite(frame.picture));
  timer.end("composition");
  for (const auto& [pass, ms] : frame.statistics.passes_ms) frame.statistics.frame_ms += ms;
  if (stop_requested()) return stopped;
  return frame;
}

void Renderer::set_camera(const Camera& camera) {
  if (is_same_view(state_->camera, camera)) return;
  state_->camera = camera;
  state_->cached.reset();
  state_->clamped.reset();
}

Status Renderer::set_scene(std::shared_ptr<const Scene> scene, PrimaryLights primaries) {
  const auto start = std::chrono::steady_clock::now();
  Result<RayScene> rays = RayScene::create(std::move(scene), {.isa = to_string(state_->settings.isa)});
  if (!rays) return rays.error();
  state_->rays = std::move(*rays);
  state_->primaries = std::move(primaries);
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
