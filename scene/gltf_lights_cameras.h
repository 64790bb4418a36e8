// SPDX-License-Identifier: Apache-2.0
// What hangs on nodes besides meshes: KHR_lights_punctual and cameras.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "base/affine.h"
#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace luciole::gltf {

// By themselves, at the origin.
std::size_t light_count(const Document& document);
PunctualLight read_light(Document& document, std::size_t light);
std::optional<Camera> read_camera(Document& document, std::size_t camera);  // nothing: orthographic

// To where a node is. Fails, naming `object`, if that is nowhere.
void place_light(PunctualLight& light, const Affine& world_from_node, const std::string& object);
void place_camera(Camera& camera, const Affine& world_from_node, const std::string& object);

// Append what the node carries, placed in the world.
void read_light_of(Document& document, const JsonObject& node, const Affine& world_from_node, Scene& scene);
void read_camera_of(Document& document, const JsonObject& node, const Affine& world_from_node, Scene& scene);

}  // namespace luciole::gltf
