// SPDX-License-Identifier: Apache-2.0
// Shadow rays between a group of pixels and one light (--direct-shadows).
#pragma once
#include <cstdint>

#include "base/vector.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/shading/pixel_group.h"

namespace luciole {

// Those of `lanes` whose pixel sees the light.
std::uint16_t unoccluded_lanes(const RayScene& scene, const PixelGroup& group, Vec3 light, std::uint16_t lanes);

}  // namespace luciole
