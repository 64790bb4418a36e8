// SPDX-License-Identifier: Apache-2.0
// What the hall is built of. All textures are painted by code and repeat without a seam.
#pragma once
#include "scene/recipes/scene_kit.h"

namespace luciole::workshop::gallery {

// Indices into Scene::materials.
struct HallMaterials {
  std::uint32_t marble_floor, plaster, limestone, brick, oak, carpet, velvet, lead;
};

// How many metres one repeat of each texture covers.
inline constexpr float kFloorTile = 2.4f, kPlasterTile = 2.0f, kStoneTile = 1.2f, kBrickTile = 1.2f, kOakTile = 1.6f;

// texture_size: side of the largest textures in texels, a power of two; others are half of it.
HallMaterials add_hall_materials(Scene& scene, std::uint32_t texture_size);

}  // namespace luciole::workshop::gallery
