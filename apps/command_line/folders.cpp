// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/folders.h"

#include <cstdlib>
#include <system_error>

namespace luciole {

SearchFolders search_folders(const std::string& asked_scenes) {
  namespace fs = std::filesystem;
  SearchFolders folders;
  folders.shots = {"shots"};
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  if (!code) {
    const fs::path above = program.parent_path().parent_path();  // of bin/luciole, or of build/luciole
    folders.shots.push_back(above / "share" / "luciole" / "shots");
    folders.shots.push_back(above / "shots");
  }
  const char* variable = std::getenv("LUCIOLE_SCENES");
  if (!asked_scenes.empty()) {
    folders.scenes = {asked_scenes};
  } else if (variable != nullptr && *variable != '\0') {
    folders.scenes = {variable};
  } else {
    folders.scenes = {"scenes"};
  }
  return folders;
}

}  // namespace luciole
