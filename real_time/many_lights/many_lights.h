// SPDX-License-Identifier: Apache-2.0
// Door: punctual lights that are not primary, and emissive triangles: direct light through the same culling. Radiant
// intensity towards w_o: intensity * g(w_o . axis), g(c) = s(t) with t = clamp(max(c, -c * two_sided) * scale + offset,
// 0, 1), s(t) = t for squared = 0 and t^2 for squared = 1: points (scale 0, offset 1), spots, one- and two-sided
// emitters (scale 1, offset 0) in one form without branches.
#pragma once
#include <cstdint>

#include "base/aligned_vector.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/reflective_shadow_map/primary_light.h"
#include "real_time/settings.h"

namespace luciole {

struct ManyLights {
  Plane3 position;   // world [m]; emissive triangles: one uniformly drawn point per triangle, seed and frame
  Plane3 axis;       // unit
  Plane3 intensity;  // largest over directions, RGB [W/sr]; triangles: radiance * area
  Plane scale, offset, two_sided, squared;
  Plane area;  // emitter's area [m^2], for the disc near field; 0 for punctual lights
  AlignedVector<std::uint32_t> key;

  std::size_t size() const { return key.size(); }
  void resize(std::size_t count);
};

// All lights of the scene that are neither primary nor directional, in the order of the file: first the punctual ones,
// then the emissive triangles, each with the emission at a point drawn by (settings.seed, frame, triangle). Lights
// without light are dropped; keys are places in the order before dropping.
ManyLights make_many_lights(const Scene& scene, const PrimaryLights& primaries, const Settings& settings,
                            std::uint64_t frame_index);

}  // namespace luciole
