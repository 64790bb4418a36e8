// SPDX-License-Identifier: Apache-2.0
// What is on show, and what it stands on.
#pragma once
#include "scene/recipes/gallery/materials.h"

namespace luciole::workshop::gallery {

void add_exhibits(Scene& scene, const HallMaterials& materials, Detail detail);

}  // namespace luciole::workshop::gallery
