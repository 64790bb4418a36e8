// SPDX-License-Identifier: Apache-2.0
#include "offline/render.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "base/parallel.h"
#include "offline/light_sample/make_light_sampler.h"
#include "offline/path/path_batch.h"
#include "offline/path/probe_paths.h"

namespace luciole {

struct PathTracer::State {
  PathSettings settings;
  RayScene rays;
  SurfaceTables surfaces;
  LightSet lights;
  InfiniteLights infinite;
  CameraRays camera;
  VisibleEmitters visible;
  std::unique_ptr<LightSampler> sampler;
  float colour_share = 0;
  PathStatistics statistics;
  std::vector<FilmSample> samples;  // of one pass
  double bvh_build_ms;

  State(RayScene traced, const Camera& view, const PathSettings& wanted)
      : settings(wanted),
        rays(std::move(traced)),
        surfaces(rays.scene()),
        lights(rays.scene()),
        infinite(rays.scene()),
        camera(view, with_focus(wanted, rays, view)),
        visible(rays, lights, camera, settings),
        bvh_build_ms(0) {}

  static PathSettings with_focus(PathSettings settings, const RayScene& rays, const Camera& view) {
    if (settings.aperture > 0 && settings.focus == 0) settings.focus = distance_at_centre(rays, view);
    return settings;
  }
};

PathTracer::PathTracer(std::unique_ptr<State> state) : state_(std::move(state)) {}
PathTracer::PathTracer(PathTracer&&) noexcept = default;
PathTracer& PathTracer::operator=(PathTracer&&) noexcept = default;
PathTracer::~PathTracer() = default;

Result<PathTracer> PathTracer::create(std::shared_ptr<const Scene> scene, const Camera& camera,
                                      const PathSettings& settings) {
  const Result<Isa> isa = choose_isa(settings.isa);
  if (!isa) return isa.error();
  RayTracingOptions options;
  options.blend_at_random = true;
  if (settings.isa != Isa::automatic) options.isa = to_string(*isa);
  const auto start = std::chrono::steady_clock::now();
  Result<RayScene> rays = RayScene::create(std::move(scene), options);
  if (!rays) return rays.error();
  PathSettings resolved = settings;
  resolved.isa = *isa;
  auto state = std::make_unique<State>(std::move(*rays), camera, resolved);
  state->bvh_build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  state->settings = State::with_focus(resolved, state->rays, camera);
  const std::vector<Receiver> receivers = probe_receivers(state->rays, state->camera, state->settings);
  state->sampler = make_light_sampler({state->rays.scene(), state->lights, state->settings, receivers,
                                       std::max(state->rays.bounds().diagonal(), 1e-6f)});
  state->colour_share = colour_share(state->rays, state->lights, *state->sampler, receivers);
  if (state->settings.error_bound == 0) state->settings.error_bound = state->sampler->error_bound();
  state->samples.resize(std::size_t(settings.width) * settings.height);
  return PathTracer(std::move(state));
}

bool PathTracer::add_sample(Film& film) {
  State& s = *state_;
  s.sampler->begin_pass(film.range().end);
  const PathContext context{s.rays,   s.surfaces, s.lights,   s.infinite,     *s.sampler,
                            s.camera, s.visible,  s.settings, s.colour_share, film.range().end};
  const std::uint32_t columns = (s.settings.width + PathBatch::kSide - 1) / PathBatch::kSide;
  const std::uint32_t rows = (s.settings.height + PathBatch::kSide - 1) / PathBatch::kSide;
  std::mutex guard;
  PathStatistics pass;
  parallel_for(std::size_t(columns) * rows, 1, [&](std::size_t begin, std::size_t end) {
    PathBatch batch(context);
    for (std::size_t tile = begin; tile < end && !stop_requested(); ++tile) {
      batch.render(static_cast<std::uint32_t>(tile % columns) * PathBatch::kSide,
                   static_cast<std::uint32_t>(tile / columns) * PathBatch::kSide, s.samples.data());
    }
    const std::lock_guard lock(guard);
    pass += batch.statistics();
  });
  if (stop_requested()) return false;
  pass.rays += s.visible.add_to(film.range().end, s.samples);
  s.statistics += pass;
  film.add(s.samples);
  return true;
}

const PathSettings& PathTracer::settings() const { return state_->settings; }
const PathStatistics& PathTracer::statistics() const { return state_->statistics; }
std::uint64_t PathTracer::light_count() const { return state_->lights.size(); }
std::uint64_t PathTracer::light_bytes() const {
  return state_->lights.memory_bytes() + state_->visible.memory_bytes() + state_->sampler->memory_bytes();
}
double PathTracer::bvh_build_ms() const { return state_->bvh_build_ms; }

}  // namespace luciole
