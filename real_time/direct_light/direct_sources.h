// SPDX-License-Identifier: Apache-2.0
// Which lights are direct light's, in the order in which pixels add them.
#pragma once
#include <vector>

#include "real_time/direct_light/direct_records.h"
#include "real_time/reflective_shadow_map/primary_light.h"

namespace luciole {

// The primary lights, then the scene's other directional ones.
PrimaryLights direct_lights(const Scene& scene, const PrimaryLights& primaries);
std::vector<DirectSource> direct_sources(const PrimaryLights& lights);

}  // namespace luciole
