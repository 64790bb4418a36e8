// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "shot/find_shot.h"

namespace luciole {

// Shots: ./shots, then those installed with the program or beside its sources. Scenes: the folder that was asked for,
// else $LUCIOLE_SCENES, else ./scenes.
SearchFolders search_folders(const std::string& asked_scenes);

}  // namespace luciole
