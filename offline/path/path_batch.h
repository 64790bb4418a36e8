// SPDX-License-Identifier: Apache-2.0
// The paths of one tile of pixels, all of them one scattering at a time: so that rays go in full packets and what is
// done to each surface point stays in the cache.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "offline/film/film.h"
#include "offline/light_sample/light_sampler.h"
#include "offline/light_set/infinite_lights.h"
#include "offline/path/bsdf.h"
#include "offline/path/camera_rays.h"
#include "offline/path/sample_sequence.h"
#include "offline/path/visible_emitters.h"
#include "offline/render.h"
#include "ray_tracing/ray_scene.h"
#include "scene/make_surface_tables.h"
#include "scene/surface_kernel.h"

namespace luciole {

// What paths need to know; all of it constant within a pass.
struct PathContext {
  const RayScene& rays;
  const SurfaceTables& surfaces;
  const LightSet& lights;
  const InfiniteLights& infinite;
  const LightSampler& sampler;
  const CameraRays& camera;
  const VisibleEmitters& visible;
  const PathSettings& settings;
  float colour_share = 0;  // of the correction of colours
  std::uint64_t sample = 0;
};

// Light sampled at a surface point, to be added if nothing is in its way.
struct ShadowRay {
  Vec3 origin, towards;  // [m]; blocked if something lies between them
  Vec3 light;            // throughput included
  std::uint32_t path, random;
};

class PathBatch {
 public:
  // [pixels]: large, so that what reflections meet lies close enough to share its candidates (kGroup); small, so that
  // the paths stay in the cache.
  static constexpr std::uint32_t kSide = 32;
  static constexpr std::uint32_t kPaths = kSide * kSide;

  explicit PathBatch(const PathContext& context) : context_(context), paths_(kPaths) {}

  // Traces the paths of the tile at (left, top), as far as it lies in the picture, and writes their samples.
  void render(std::uint32_t left, std::uint32_t top, FilmSample* samples);
  const PathStatistics& statistics() const { return statistics_; }

 private:
  struct Path {
    Vec3 origin, direction;  // of the ray to be traced
    Vec3 throughput, radiance, albedo, normal;
    SampleSequence numbers{0, 0, 0};
    std::uint32_t pixel = 0;
    // The surface point that the ray left; none for camera rays.
    Receiver from;
    ChoiceMemory choice;
    float bsdf_pdf = 0;  // 0: camera ray
    Vec2 film_offset;
  };
  // A surface point that looks for light and scatters its path.
  struct Arrival {
    std::uint32_t place, path;  // place: on a Morton curve through the scene
    SurfacePoint point;
  };

  void begin(std::uint32_t left, std::uint32_t top);
  void trace_all(std::uint32_t scattering);
  void arrive_all(const std::uint32_t* paths, int count, const HitPacket& hits, std::uint32_t scattering);
  void evaluate_together(const std::uint32_t* paths, const HitPacket& hits, std::uint32_t scattering,
                         SurfaceAnswers& answers) const;
  float cone_width(const Path& path, float distance, std::uint32_t scattering) const;
  void arrive(std::uint32_t index, const SurfaceHit& hit, float distance, const SurfacePoint& point,
              std::uint32_t scattering);
  void scatter_all(std::uint32_t scattering);
  void scatter_group(const std::uint32_t* arrivals, std::uint32_t count, std::uint32_t scattering);
  bool scatter(const Arrival& arrival, const Bsdf& bsdf, std::uint32_t scattering);  // whether the path goes on

  float last_diffuse_share() const;
  void add_sky(Path& path) const;
  void add_emission(Path& path, const SurfaceHit& hit, float distance, const SurfacePoint& point) const;
  void ask_finite_light(const Arrival& arrival, const Bsdf& bsdf);
  void ask_infinite_light(const Arrival& arrival, const Bsdf& bsdf);
  void trace_shadow_rays();
  std::uint32_t place_of(Vec3 position) const;

  const PathContext& context_;
  std::vector<Path> paths_;
  std::vector<std::uint32_t> active_;  // paths that go on, in the order of their last surface points' places
  std::vector<Arrival> arrivals_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order_;  // (place, arrival)
  Candidates candidates_;
  std::vector<ShadowRay> shadow_rays_;
  PathStatistics statistics_;
};

// The surface point as samplers of lights see it.
Receiver receiver_of(const SurfacePoint& point, Vec3 to_eye);

// To be added to the light of one chosen lamp, visible or not: 0 on average over the choice, so that the mean stays,
// and opposite to the error that its colour makes where the others' differ. A control variate.   [W/(m^2 sr)]
Vec3 colour_correction(const SurfacePoint& point, const ChosenLight& chosen, float colour_share);

}  // namespace luciole
