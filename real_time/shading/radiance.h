// SPDX-License-Identifier: Apache-2.0
// Door: light per pixel, demodulated so that it can be filtered without blurring textures.
#pragma once
#include "real_time/geometry_buffer/geometry_buffer.h"

namespace luciole {

// radiance = diffuse * diffuse_albedo + specular, per channel; linear Rec. 709 [W/(m^2 sr)], row-major.
struct Radiance {
  Plane3 diffuse;  // by a white Lambert surface with the pixel's Fresnel loss
  Plane3 specular;

  void resize(std::size_t pixels);
};

// What lights the pixels, kept apart by where the light comes from.
struct ShadedRadiance {
  Radiance indirect;      // by both lobes of the virtual point lights
  Radiance from_diffuse;  // its part by the diffuse lobes; empty unless asked for
  Radiance from_glossy;   // its part by the glossy lobes, caustics; likewise
  Radiance from_many;     // direct, by punctual and emissive lights; empty without any
};

}  // namespace luciole
