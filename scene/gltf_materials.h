// SPDX-License-Identifier: Apache-2.0
// Materials of a glTF document: metallic-roughness, and the extensions that Material can express.
#pragma once
#include "scene/gltf_document.h"
#include "scene/gltf_textures.h"
#include "scene/scene.h"

namespace luciole::gltf {

Material read_material(Document& document, TextureReader& textures, std::size_t index);

// glTF's default material (3.9.1): white, metallic 1, roughness 1.
Material default_material();

}  // namespace luciole::gltf
