// SPDX-License-Identifier: Apache-2.0
// The door of the readers: a file to a Scene. Faults come back as one sentence with file and object.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "base/result.h"
#include "scene/file_access.h"
#include "scene/scene.h"

namespace luciole {

// By extension, in any case: .gltf, .glb, .obj. A file with nothing to draw gives a Scene without meshes.
Result<Scene> load_scene(const std::filesystem::path& path);

// The same from memory; `name` stands for the file in messages, `files` gives what the scene refers to.
Result<Scene> load_gltf(std::span<const std::uint8_t> file, const std::string& name, const FileReader& files,
                        const LoadLimits& limits = {});
Result<Scene> load_obj(std::span<const std::uint8_t> file, const std::string& name, const FileReader& files,
                       const LoadLimits& limits = {});

}  // namespace luciole
