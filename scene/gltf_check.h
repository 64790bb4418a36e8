// SPDX-License-Identifier: Apache-2.0
// The parts of a glTF document that no shown node leads to.
#pragma once
#include <cstddef>
#include <map>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace luciole::gltf {

// Reads everything once that the scene did not need and throws it away: a file that is broken anywhere is refused, so
// that a scene does not start to fail when somebody shows one more of its nodes. Images are fetched but not decoded;
// animations and skins, which nothing uses, are checked for their references and types alone.
//   read_meshes  those that need no second look
void check_the_rest(Document& document, const std::map<std::size_t, std::vector<Mesh>>& read_meshes);

}  // namespace luciole::gltf
