// SPDX-License-Identifier: Apache-2.0
// The hall: four bays under rib vaults, tall windows on one side. Closed but for the windows, so that all light inside
// has come through them or from the two spots.
#pragma once
#include "scene/recipes/gallery/materials.h"

namespace luciole::workshop::gallery {

// x across (windows at -kHalfWidth), z along (the camera stands near +kHalfLength). [m]
inline constexpr int kBays = 4;
inline constexpr float kHalfWidth = 4.5f, kBayLength = 4.8f, kHalfLength = kBays * kBayLength / 2;
inline constexpr float kSpringing = 4.2f, kRise = 3.1f;  // where the vault starts, and how far it climbs
inline constexpr float kWindowHalfWidth = 1.5f, kWindowSill = 0.8f, kWindowSpringing = 4.35f;
inline constexpr float kWallThickness = 0.55f;

inline float bay_centre(int bay) { return (static_cast<float>(bay) + 0.5f) * kBayLength - kHalfLength; }

// Height of the vault at the normalised distance s in [-1,1] from the crown of its barrel: an ellipse. [m]
float vault_height(float s);

void add_shell(Scene& scene, const HallMaterials& materials, Detail detail);    // floor, walls, windows
void add_vault(Scene& scene, const HallMaterials& materials, Detail detail);    // webs and ribs
void add_columns(Scene& scene, const HallMaterials& materials, Detail detail);  // and their bases and capitals
void add_joinery(Scene& scene, const HallMaterials& materials, Detail detail);  // doors, baseboards, cornices, carpet

}  // namespace luciole::workshop::gallery
