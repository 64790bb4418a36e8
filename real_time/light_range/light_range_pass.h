// SPDX-License-Identifier: Apache-2.0
// Pass light_range on a Vulkan device: the kernels reach_*.comp.
#pragma once
#include <array>
#include <cstdint>

#include "gpu/command_list.h"
#include "real_time/light_range/light_range_kernel.h"
#include "real_time/light_range/range_records.h"
#include "real_time/settings.h"

namespace luciole {

enum LightKind : std::uint8_t { kDiffuseLights, kGlossyLights, kManyLights, kLightKinds };

// Bytes of an emitter of each kind.
inline constexpr std::array<std::size_t, kLightKinds> kEmitterBytes = {sizeof(DiffuseEmitter), sizeof(GlossyEmitter),
                                                                       sizeof(ManyEmitter)};

// Lights of one kind on the device, laid out as ReachingLights: `entries` records in, as many emitters and bounds out.
struct LightsOnDevice {
  const gpu::Buffer* records = nullptr;  // VplRecord, or ManyLightRecord
  gpu::Buffer emitters;                  // of its kind
  gpu::Buffer bounds;                    // BoundBlock
  std::uint32_t entries = 0;             // a multiple of 16
};

// RangeParameters as the kernels read them.
RangeFrame range_frame(const RangeParameters& parameters, std::uint32_t interleave);

class LightRangePass {
 public:
  static Result<LightRangePass> create(gpu::Device& device, const Settings& settings);

  // Records the pass for all kinds that have lights.  frame: a RangeFrame
  void record(gpu::CommandList& list, const gpu::Buffer& frame,
              const std::array<LightsOnDevice, kLightKinds>& lights) const;

 private:
  std::array<gpu::Kernel, kLightKinds> kernels_;
};

}  // namespace luciole
