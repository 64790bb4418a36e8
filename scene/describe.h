// SPDX-License-Identifier: Apache-2.0
// A scene in words, for `luciole info`.
#pragma once
#include <string>

#include "scene/scene.h"

namespace luciole {

// Lines of text: bounds, counts, lights and their power, emissive triangles, cameras, warnings.
std::string describe(const Scene& scene);

}  // namespace luciole
