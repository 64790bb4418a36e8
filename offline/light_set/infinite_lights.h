// SPDX-License-Identifier: Apache-2.0
// Light from infinitely far away: suns, and the environment's image by importance. A constant sky needs no shadow rays:
// what the BSDF samples finds it as well.
#pragma once
#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace luciole {

struct InfiniteLightSample {
  Vec3 direction{0, 0, 1};  // unit, towards the light
  Vec3 radiance{0, 0, 0};   // sky [W/(m^2 sr)]; sun: irradiance [W/m^2]
  float pdf = 0;            // the choice included: per solid angle for the sky; for a sun its probability alone
  bool is_sun = false;      // no BSDF sample can hit it
};

class InfiniteLights {
 public:
  InfiniteLights() = default;
  explicit InfiniteLights(const Scene& scene);

  bool empty() const { return suns_.empty() && sums_.empty(); }
  // choice, place: numbers in [0,1).
  InfiniteLightSample sample(double choice, Vec2 place) const;
  // Density per solid angle with which `sample` gives a direction of the sky [1/sr].
  float sky_pdf(Vec3 direction) const;

 private:
  struct Sun {
    Vec3 to_sun, irradiance;
    double running_share;  // of this and the suns before it
  };
  const Environment* environment_ = nullptr;
  std::vector<Sun> suns_;
  double sun_share_ = 0;      // probability of a sun
  std::vector<double> sums_;  // running sums over the image's texels, row by row; empty: no image
};

}  // namespace luciole
