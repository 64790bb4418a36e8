// SPDX-License-Identifier: Apache-2.0
// Door: virtual point lights, one per texel of a reflective shadow map that met a surface. Each has a diffuse and a
// glossy lobe: radiant intensity I(w_o) = flux * f(w_i, w_o) * max(w_o . normal, 0), zero where w_o . geometric_normal
// is not positive ([TH17] Eq. 4).
#pragma once
#include <cstdint>

#include "base/aligned_vector.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/reflective_shadow_map/primary_light.h"
#include "real_time/settings.h"

namespace luciole {

struct VirtualPointLights {
  Plane3 position;          // world [m]
  Plane3 normal;            // shading normal, unit, on the side that the photon came from
  Plane3 geometric_normal;  // unit, same side
  Plane3 incident;          // w_i, unit, towards the primary light
  Plane3 flux;              // Phi, RGB [W]; the photon's, before reflection
  Plane3 diffuse_albedo;
  Plane3 f0;
  Plane f90;
  Plane ggx_alpha;
  Plane area;                        // the surface that the texel stands for [m^2]
  AlignedVector<std::uint32_t> key;  // texel index over all maps: keys the random numbers, never compacted

  std::size_t size() const { return key.size(); }
  void resize(std::size_t count);
};

// Sends settings.vpls photon bundles from the primary lights and leaves a light where each is reflected. Dropped are
// those that meet nothing, carry no flux, or arrive from below the shading or the geometric normal; the others keep
// their order and keys. Moved by settings.vpl_seed, and by the frame with settings.jitter.
VirtualPointLights make_virtual_point_lights(const RayScene& scene, const PrimaryLights& primaries,
                                             const Settings& settings, std::uint64_t frame_index);

}  // namespace luciole
