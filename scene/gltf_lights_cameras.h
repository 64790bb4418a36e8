// SPDX-License-Identifier: Apache-2.0
// What hangs on nodes besides meshes: KHR_lights_punctual and cameras.
#pragma once
#include "base/affine.h"
#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace luciole::gltf {

// Append what the node carries, placed in the world.
void read_light_of(Document& document, const JsonObject& node, const Affine& world_from_node, Scene& scene);
void read_camera_of(Document& document, const JsonObject& node, const Affine& world_from_node, Scene& scene);

}  // namespace luciole::gltf
