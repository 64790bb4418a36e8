// SPDX-License-Identifier: Apache-2.0
// Door: what the camera sees, one value per pixel in planes (structure of arrays), row-major, row 0 on top.
#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "base/aligned_vector.h"
#include "scene/scene.h"

namespace luciole {

using Plane = AlignedVector<float>;   // one float per pixel
using Plane3 = std::array<Plane, 3>;  // x, y, z or r, g, b

inline constexpr float kNoSurface = std::numeric_limits<float>::infinity();

struct GeometryBuffer {
  std::uint32_t width = 0, height = 0;
  Camera camera;                                 // as used, sub-pixel offset excluded
  float sub_pixel_x = 0.5f, sub_pixel_y = 0.5f;  // where in the pixel the ray went, [0,1)
  Plane depth;                                   // distance along camera.forward [m]; kNoSurface where the sky is seen
  Plane3 position;                               // world [m]
  Plane3 normal;                                 // shading normal, unit, on the viewer's side
  Plane3 geometric_normal;                       // unit, on the viewer's side
  Plane3 diffuse_albedo;                         // (1 - metallic) * base colour
  Plane3 f0;                                     // Fresnel reflectance at normal incidence
  Plane f90;
  Plane ggx_alpha;                        // [TH17] alpha, >= 1e-3
  Plane3 emission;                        // radiance towards the viewer [W/(m^2 sr)]; the sky where there is no surface
  AlignedVector<std::uint32_t> material;  // index; 0xffffffff for the sky

  std::size_t pixel_count() const { return std::size_t(width) * height; }
  void resize(std::uint32_t new_width, std::uint32_t new_height);
};

}  // namespace luciole
