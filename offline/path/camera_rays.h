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
};

// Place relative to the pixel's centre, distributed as the filter weighs [pixels].
//   u  two numbers in (0,1)
Vec2 filter_offset(PixelFilter filter, Vec2 u);

class CameraRays {
 public:
  // settings.focus must be set if settings.aperture is.
  CameraRays(const Camera& camera, const PathSettings& settings);

  CameraRay ray(std::uint32_t x, std::uint32_t y, Vec2 filter_numbers, Vec2 lens_numbers) const;
  float pixel_size() const { return pixel_size_; }  // height of a pixel at distance 1 [m]
  // Depth, along the view, at which a ray of unit direction has gone `distance`.
  float depth(Vec3 direction, float distance) const { return dot(direction, camera_.forward) * distance; }

 private:
  Camera camera_;
  PixelFilter filter_;
  float pixel_size_, half_width_, half_height_;  // half sizes in pixels
  float aperture_, focus_;
};

}  // namespace luciole
