// SPDX-License-Identifier: Apache-2.0
// Texels of the reflective shadow maps -> virtual point lights.
#pragma once
#include <vector>

#include "real_time/reflective_shadow_map/reflective_shadow_map.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"

namespace luciole {

// One light per texel that reflects something, in the order of the texels: dropped are those that met nothing, that
// carry no flux, and whose photon came from below the shading or the geometric normal. The key stays the texel's.
void place_virtual_point_lights(const std::vector<SurfaceTexel>& texels, VirtualPointLights& lights);

}  // namespace luciole
