// SPDX-License-Identifier: Apache-2.0
// The tables of a scene for evaluate_surfaces. They point into the scene and must not outlive it.
#pragma once
#include <vector>

#include "scene/scene.h"
#include "scene/surface_tables.h"

namespace luciole {

class SurfaceTables {
 public:
  explicit SurfaceTables(const Scene& scene);
  SurfaceTables(const SurfaceTables&) = delete;
  SurfaceTables& operator=(const SurfaceTables&) = delete;

  const SurfaceMesh& mesh(std::uint32_t index) const { return meshes_[index]; }

 private:
  SurfaceSlot slot(const TextureSlot& from) const;
  SurfaceMaterial material(const Material& from, bool has_tangents) const;

  std::vector<SurfaceTexture> textures_;
  std::vector<SurfaceMesh> meshes_;
};

}  // namespace luciole
