// SPDX-License-Identifier: Apache-2.0
// Limits and files of the fuzz targets.
#pragma once
#include <cstdint>
#include <string>

#include "scene/animation.h"
#include "scene/describe.h"
#include "scene/load_scene.h"
#include "scene/surface.h"

namespace luciole::fuzz {

// Small, so that a find is a fault of ours and not a large scene.
inline LoadLimits limits() {
  LoadLimits result;
  result.file_bytes = result.buffer_bytes = 1u << 24;
  result.vertices = 1u << 16;
  result.texels = 1u << 18;
  result.image_side = 1024;
  return result;
}

// What the rest of the program does to a loaded scene: every vertex, material and texture is touched.
inline void use(const Result<Scene>& loaded) {
  if (!loaded) return;
  const Scene& scene = *loaded;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    const auto triangles = static_cast<std::uint32_t>(scene.meshes[mesh].indices.size() / 3);
    for (std::uint32_t triangle = 0; triangle < triangles && triangle < 64; ++triangle) {
      const SurfaceHit hit{mesh, triangle, 0.3f, 0.3f};
      evaluate_surface(scene, hit, Vec3(0, 0, -1), 0.01f);
      alpha_passes(scene, hit);
    }
  }
  if (scene.triangle_count() < 1000) describe(scene);
  if (!scene.animation || scene.triangle_count() > 1000) return;
  Scene moved = scene;
  for (const double time : {0.0, 0.4, double(scene.animation->duration())}) (void)pose_scene(moved, time);
}

}  // namespace luciole::fuzz
