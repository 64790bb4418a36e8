// SPDX-License-Identifier: Apache-2.0
// A Scene as glTF 2.0, for other programs and for load_scene.
#pragma once
#include <filesystem>

#include "base/result.h"
#include "scene/scene.h"

namespace luciole {

// NAME.glb holds everything; NAME.gltf gets NAME.bin and NAME_0.png, NAME_1.png ... beside it. Files appear whole or
// not at all, the one that was asked for last. Meshes stay in world space, one node each; those that move hang on
// nodes with their tracks. Lights are written 1:1
// (KHR_lights_punctual), materials with KHR_materials_emissive_strength, _ior, _specular and KHR_texture_transform
// where they need them. What glTF has no word for is left out: the environment and a shot's overrides of materials.
Status write_gltf(const Scene& scene, const std::filesystem::path& path);

}  // namespace luciole
