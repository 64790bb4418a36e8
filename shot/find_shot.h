// SPDX-License-Identifier: Apache-2.0
// From what a user types to a shot: a shot's name or file, a scene's file, or a recipe.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "shot/shot.h"

namespace luciole {

// Searched in order. Names are tried as they are before any folder.
struct SearchFolders {
  std::vector<std::filesystem::path> shots, scenes;
};

//   name   "hall" (shots/hall.toml), "my/hall.toml", "recipe:ring?alpha=0.1", "sponza/sponza.gltf", "scene.glb"
// A scene or a recipe becomes a shot without camera, lights and settings of its own.
Result<Shot> find_shot(const std::string& name, const SearchFolders& folders);

// Where a scene's file lies; failed with a sentence that names the folders that were searched.
Result<std::filesystem::path> find_scene_file(const std::string& name, const SearchFolders& folders);

// Names of the shots in the folders, sorted, each once.
std::vector<std::string> shot_names(const SearchFolders& folders);

}  // namespace luciole
