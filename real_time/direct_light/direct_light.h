// SPDX-License-Identifier: Apache-2.0
// Door: light that reaches the pixels straight from the primary lights, with ray-traced shadows.
#pragma once
#include "ray_tracing/ray_scene.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/reflective_shadow_map/primary_light.h"
#include "real_time/settings.h"

namespace luciole {

// Radiance towards the eye [W/(m^2 sr)], one value per pixel, 0 at the sky. Lit are the primary lights and the scene's
// other directional ones, which no range could bound. Full BRDF of the pixel, shading normal, nothing from below the
// geometric normal; no angular size: shadows are hard.
//   isa  not automatic; same bits for any number of threads
Plane3 direct_light(const RayScene& rays, const GeometryBuffer& geometry, const PrimaryLights& primaries, Isa isa);

}  // namespace luciole
