// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ to a Scene.
#pragma once
#include <span>

#include "scene/file_access.h"
#include "scene/scene.h"

namespace luciole::obj {

// Polygons of at most 1,024 corners; free-form surfaces, points and lines are ignored. Throws FileFault.
Scene read_scene(std::span<const std::uint8_t> file, const FileReader& files, const LoadLimits& limits);

}  // namespace luciole::obj
