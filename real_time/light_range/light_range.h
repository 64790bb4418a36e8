// SPDX-License-Identifier: Apache-2.0
// Pass: lights -> lights with this frame's random ranges and bounds, grouped by interleaving subset.
#pragma once
#include "real_time/light_range/light_range_kernel.h"
#include "real_time/many_lights/many_lights.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"

namespace luciole {

struct FrameKey {
  std::uint64_t seed, frame_index;
};

// Which subset a sub-region starts with this frame: uniform in [0, n^2), so that over frames every pixel sees every
// light equally often.
std::uint32_t subset_shift(const FrameKey& key, std::uint32_t interleave);

// What the range kernels need of the settings.
//   constant_xi  for clamped and infinite ranges; negative: random
RangeParameters range_parameters(const Settings& settings, const Camera& camera, const FrameKey& key,
                                 float constant_xi);

// One entry per lobe that exists. `isa` is resolved.
ReachingLights<DiffuseEmitter> reach_diffuse_lobes(const VirtualPointLights& lights, const RangeParameters& parameters,
                                                   std::uint32_t interleave, Isa isa);
ReachingLights<GlossyEmitter> reach_glossy_lobes(const VirtualPointLights& lights, const RangeParameters& parameters,
                                                 std::uint32_t interleave, Isa isa);
ReachingLights<ManyEmitter> reach_many_lights(const ManyLights& lights, const RangeParameters& parameters,
                                              std::uint32_t interleave, Isa isa);

}  // namespace luciole
