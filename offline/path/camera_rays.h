// SPDX-License-Identifier: Apache-2.0
// Where paths begin: a thin lens, and pixel filters by importance, so that a sample belongs to one pixel only.
//   M. Ernst et al., "Filter Importance Sampling", 2006.
#pragma once
#include <cstdint>

#include "base/vector.h"
#include "offline/settings.h"
#include "scene/scene.h"

namespace luciole {

struct CameraRay {
  Vec3 origin{0, 0, 0}, direction{0, 0, 1};  // unit
  Vec2 offset{0, 0};                         // where it pierces the film, from the pixel's centre [pixels]
};

// Where a point of the scene falls on the film.
struct FilmPlace {
  bool in_front = false;  // of the camera; else nothing else is valid
  Vec3 lens{0, 0, 0};     // the point of the lens through which it is seen
  Vec2 pixels{0, 0};      // from the film's upper left corner
};

// Place relative to the pixel's centre, distributed as the filter weighs [pixels].
//   u  two numbers in (0,1)
Vec2 filter_offset(PixelFilter filter, Vec2 u);
// Density of those places [1/pixel^2].
float filter_density(PixelFilter filter, Vec2 offset);
// Farther than this from the centre along either axis it is 0 [pixels].
float filter_radius(PixelFilter filter);

class CameraRays {
 public:
  // settings.focus must be set if settings.aperture is.
  CameraRays(const Camera& camera, const PathSettings& settings);

  CameraRay ray(std::uint32_t x, std::uint32_t y, Vec2 filter_numbers, Vec2 lens_numbers) const;
  // lens_numbers: as for rays.
  FilmPlace place_of(Vec3 point, Vec2 lens_numbers) const;
  // Area on the film per area of a surface [pixels^2/m^2].
  //   direction    unit, from the lens to the surface
  //   cos_surface  between it and the surface's normal
  float film_per_area(Vec3 direction, float distance_sq, float cos_surface) const;
  PixelFilter filter() const { return filter_; }
  Vec3 eye() const { return camera_.eye; }
  float pixel_size() const { return pixel_size_; }  // height of a pixel at distance 1 [m]
  // Depth, along the view, at which a ray of unit direction has gone `distance`.
  float depth(Vec3 direction, float distance) const { return dot(direction, camera_.forward) * distance; }

 private:
  Vec3 on_lens(Vec2 lens_numbers) const;  // from the eye

  Camera camera_;
  PixelFilter filter_;
  float pixel_size_, half_width_, half_height_;  // half sizes in pixels
  float aperture_, focus_;
};

}  // namespace luciole
