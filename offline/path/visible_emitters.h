// SPDX-License-Identifier: Apache-2.0
// Lamps that the camera sees directly. A lamp smaller than a pixel is met by few of the pixel's rays, and a lamp is
// thousands of times brighter than what it lights: it makes most of a picture's error. Points on emitters are projected
// onto the film as well, several per pixel that an emitter covers: each costs no more than a shadow ray. Both ways are
// combined by the balance heuristic.   [Veach 1997, sect. 10.3: light paths that meet the lens]
#pragma once
#include <cstdint>
#include <vector>

#include "offline/film/film.h"
#include "offline/light_set/light_set.h"
#include "offline/path/camera_rays.h"
#include "ray_tracing/ray_scene.h"

namespace luciole {

class VisibleEmitters {
 public:
  // All must outlive this.
  VisibleEmitters(const RayScene& rays, const LightSet& lights, const CameraRays& camera, const PathSettings& settings);

  // Adds the projected points of one pass to the samples of its pixels. Returns how many rays it took.
  std::uint64_t add_to(std::uint64_t pass, std::vector<FilmSample>& samples) const;

  // The balance heuristic's weight of a camera ray that has met a light.
  //   ray       that met it
  //   distance  to the light [m]
  float weight_of_camera_ray(std::uint32_t light, const CameraRay& ray, float distance) const;

  std::uint64_t memory_bytes() const { return points_per_area_.size() * sizeof(float); }

 private:
  struct Splat {
    std::uint32_t pixel;
    Vec3 radiance;
  };
  struct Projection {
    Vec3 lens, end;  // of the ray
    Vec3 radiance;
    Vec2 pixels;
    float film_per_area;  // [pixels^2/m^2]
    std::uint32_t light, random;
  };

  float expected_points(const LightRecord& light) const;
  float area_of(const LightRecord& light) const;
  void project(std::uint32_t light, std::uint64_t pass, std::vector<Projection>& projections) const;
  void splat(const Projection& projection, std::vector<Splat>& splats) const;
  void splat_visible(const std::vector<Projection>& projections, std::vector<Splat>& splats) const;

  const RayScene& rays_;
  const LightSet& lights_;
  const CameraRays& camera_;
  const PathSettings& settings_;
  std::vector<float> points_per_area_;  // by light, expected in a pass [1/m^2]
};

}  // namespace luciole
