// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "base/result.h"
#include "scene/scene.h"

namespace luciole {

// bad_scene where a triangle of the mesh refers to a vertex that does not exist.
Status check_indices(const Mesh& mesh);

}  // namespace luciole
