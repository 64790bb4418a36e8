// SPDX-License-Identifier: Apache-2.0
// Meshes of a glTF document: primitives to indexed triangles, in the space of the mesh.
#pragma once
#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace luciole::gltf {

// `mesh.material` is the document's material index, or kNoMaterial.
inline constexpr std::uint32_t kNoMaterial = 0xffffffffu;

// The drawable primitives of a mesh; points and lines are left out with one warning.
std::vector<Mesh> read_mesh(Document& document, std::size_t mesh);

}  // namespace luciole::gltf
