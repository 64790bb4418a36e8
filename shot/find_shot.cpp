// SPDX-License-Identifier: Apache-2.0
#include "shot/find_shot.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "base/text.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

std::string lower_case_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& letter : extension) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return extension;
}

bool is_scene_file(const fs::path& path) {
  const std::string extension = lower_case_extension(path);
  return extension == ".gltf" || extension == ".glb" || extension == ".obj";
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

std::optional<fs::path> find_in(const fs::path& name, const std::vector<fs::path>& folders) {
  if (is_there(name)) return name;
  if (name.is_absolute()) return std::nullopt;
  for (const fs::path& folder : folders) {
    if (is_there(folder / name)) return folder / name;
  }
  return std::nullopt;
}

std::vector<std::string> as_text(const std::vector<fs::path>& folders) {
  std::vector<std::string> list;
  for (const fs::path& folder : folders) list.push_back(folder.string());
  return list;
}

}  // namespace

Result<fs::path> find_scene_file(const std::string& name, const SearchFolders& folders) {
  if (const std::optional<fs::path> path = find_in(name, folders.scenes)) return *path;
  const std::string searched = folders.scenes.empty() ? "" : ", nor in " + joined(as_text(folders.scenes));
  return Error{ErrorKind::failed,
               name + ": no such scene file" + searched + "; say where scenes are by --scenes or LUCIOLE_SCENES"};
}

Result<Shot> find_shot(const std::string& name, const SearchFolders& folders) {
  Shot bare;
  bare.scene = name;
  if (is_recipe_address(name)) return bare;
  if (is_scene_file(name)) {
    const Result<fs::path> path = find_scene_file(name, folders);
    if (!path) return path.error();
    bare.scene = path->string();
    return bare;
  }
  const bool has_extension = lower_case_extension(name) == ".toml";
  const fs::path file_name = has_extension ? fs::path(name) : fs::path(name + ".toml");
  if (const std::optional<fs::path> path = find_in(file_name, folders.shots)) return read_shot(*path);
  if (is_there(name)) {
    return Error{ErrorKind::usage, name + ": neither a shot (.toml) nor a scene (.gltf, .glb, .obj)"};
  }
  const std::vector<std::string> known = shot_names(folders);
  return Error{ErrorKind::failed, name + ": no such shot or scene; " +
                                      (known.empty() ? "no shots were found either" : "shots: " + joined(known))};
}

std::vector<std::string> shot_names(const SearchFolders& folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders.shots) {
    std::error_code code;
    for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
      if (lower_case_extension(entry->path()) == ".toml") names.insert(entry->path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace luciole
