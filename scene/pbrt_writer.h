// SPDX-License-Identifier: Apache-2.0
// A Scene for pbrt-v4, as far as both describe it the same: the same picture from two programs that share no line.
#pragma once
#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "scene/scene.h"

namespace luciole {

// What a file for pbrt says beside the scene.
struct PbrtPicture {
  std::uint32_t width = 1280, height = 720;  // [pixels]
  std::uint32_t bounces = 3;                 // surface scatterings: 1 is direct light
  std::uint32_t samples = 16;                // per pixel
};

// NAME.pbrt gets NAME_0.ply, NAME_1.ply ... beside it, one per mesh in world space. It asks for the path integrator
// with the light sampler `bvh`, a box filter of one pixel and radiance 1:1 in NAME.exr. The view is the scene's first
// camera or, without one, the framing camera.
//
// Written are Lambert surfaces (no reflectance: KHR_materials_specular 0), rough metals of F0 = 1, emission of their
// triangles, point and directional lights. All else is refused in one sentence that names the material or light: other
// reflectances (pbrt has no Schlick), textures (filtered otherwise), vertex colours, holes, spots (another ramp),
// skies.
//
// Two differences stay. pbrt carries spectra: products of saturated colours differ, those with a grey factor do not.
// And where interpolated normals leave the triangle's own, a light between both horizons may count in one program only.
Status write_pbrt(const Scene& scene, const PbrtPicture& picture, const std::filesystem::path& path);

}  // namespace luciole
