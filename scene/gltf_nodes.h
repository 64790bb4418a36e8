// SPDX-License-Identifier: Apache-2.0
// The node hierarchy of a glTF document, walked without recursion.
#pragma once
#include <cstddef>
#include <functional>

#include "base/affine.h"
#include "scene/gltf_document.h"

namespace luciole::gltf {

// Calls visit(node, world_from_node) for every node of the scene that is shown by default (the first one if the file
// does not say), parents first, in the file's order. The whole graph is checked before: NODE_LOOP,
// NODE_PARENT_OVERRIDE, SCENE_NON_ROOT_NODE, and a depth of at most 1,024.
void for_each_node(const Document& document, const std::function<void(std::size_t, const Affine&)>& visit);

// The map of one translation, rotation (x, y, z, w; any length but zero) and scale.
Affine affine_from_parts(Vec3 translation, Vec4 rotation, Vec3 scale, const std::string& object);

}  // namespace luciole::gltf
