// SPDX-License-Identifier: Apache-2.0
// A fingerprint of everything in a scene that a picture can depend on.
#pragma once
#include <string>

#include "scene/scene.h"

namespace luciole {

// 16 hexadecimal digits: meshes, materials, textures, lights, environment. Not: names, warnings, cameras.
std::string scene_digest(const Scene& scene);

}  // namespace luciole
