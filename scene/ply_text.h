// SPDX-License-Identifier: Apache-2.0
// A mesh as a PLY file, binary and little-endian.
#pragma once
#include <string>

#include "scene/scene.h"

namespace luciole {

// Positions, normals where the mesh has some, and all triangles that have an area.
std::string ply_text(const Mesh& mesh);

}  // namespace luciole
