// SPDX-License-Identifier: Apache-2.0
// The [camera] of a shot: at rest, or on a path of keys.
#pragma once
#include <toml++/toml.h>

#include <optional>
#include <string>

#include "shot/shot.h"

namespace luciole {

//   file   its name, for sentences
//   fault  of the whole file; see TableReader
// Sets camera, and camera_path where there are keys. Needs shot.frames_per_second.
void read_camera(const toml::table& camera, const std::string& file, std::optional<Error>& fault, Shot& shot);

}  // namespace luciole
