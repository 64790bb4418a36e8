// SPDX-License-Identifier: Apache-2.0
// A glTF document to a Scene.
#pragma once
#include <span>

#include "scene/file_access.h"
#include "scene/scene.h"

namespace luciole::gltf {

// `file` is the text of a .gltf or a .glb container, told by its first bytes unless the name says .glb. Throws
// FileFault.
Scene read_scene(std::span<const std::uint8_t> file, bool must_be_glb, FileReader files, const LoadLimits& limits);

}  // namespace luciole::gltf
