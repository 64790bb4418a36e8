// SPDX-License-Identifier: Apache-2.0
// Progressive path tracing on the CPU. This is the door of offline for programs.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "offline/film/film.h"
#include "offline/settings.h"
#include "scene/scene.h"

namespace luciole {

struct PathStatistics {
  std::uint64_t rays = 0;           // traced, shadow rays included
  std::uint64_t paths = 0;          // camera rays
  std::uint64_t light_choices = 0;  // shading points that asked for a light
  std::uint64_t candidates = 0;     // lights that were weighed for them

  PathStatistics& operator+=(const PathStatistics& other) {
    rays += other.rays, paths += other.paths;
    light_choices += other.light_choices, candidates += other.candidates;
    return *this;
  }
};

class PathTracer {
 public:
  // Lights are those of scene.lights, all of them, the emissive triangles and the environment. What the tracer learns
  // ahead (error bound, focus) depends on scene, camera and settings only.
  static Result<PathTracer> create(std::shared_ptr<const Scene> scene, const Camera& camera,
                                   const PathSettings& settings);

  // Adds one sample to every pixel: number film.range().end. The same bits on any number of threads. False if
  // stop_requested() ended it early: then the film is as before.
  bool add_sample(Film& film);

  const PathSettings& settings() const;  // error_bound and focus as chosen
  const PathStatistics& statistics() const;
  std::uint64_t light_count() const;  // triangles and punctual lights that take part in the choice of lights
  std::uint64_t light_bytes() const;  // memory of lights and their tree
  double bvh_build_ms() const;

  PathTracer(PathTracer&&) noexcept;
  PathTracer& operator=(PathTracer&&) noexcept;
  ~PathTracer();

 private:
  struct State;
  explicit PathTracer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace luciole
