// SPDX-License-Identifier: Apache-2.0
// The node hierarchy of a glTF document, walked without recursion.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>

#include "base/affine.h"
#include "scene/gltf_document.h"

namespace luciole::gltf {

struct NodeVisit {
  std::size_t node;
  std::optional<std::size_t> parent;
  Affine world_from_parent, parent_from_node, world_from_node;
};

// Calls visit for every node of the scene that is shown by default (the first one if the file
// does not say), parents first, in the file's order. The whole graph is checked before: NODE_LOOP,
// NODE_PARENT_OVERRIDE, SCENE_NON_ROOT_NODE, and a depth of at most 1,024.
void for_each_node(const Document& document, const std::function<void(const NodeVisit&)>& visit);

// The map of one translation, rotation (x, y, z, w; any length but zero) and scale.
Affine affine_from_parts(Vec3 translation, Vec4 rotation, Vec3 scale, const std::string& object);

}  // namespace luciole::gltf
