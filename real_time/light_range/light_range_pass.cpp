// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_range/light_range_pass.h"

#include <algorithm>
#include <cstddef>

namespace luciole {

extern const gpu::ShaderCode reach_diffuse;
extern const gpu::ShaderCode reach_glossy;
extern const gpu::ShaderCode reach_many;

namespace {

constexpr std::uint32_t kThreads = 64;  // of a workgroup of reach_*.comp

void copy(const float (&from)[3], float (&to)[3]) { std::copy(from, from + 3, to); }

}  // namespace

RangeFrame range_frame(const RangeParameters& p, std::uint32_t interleave) {
  RangeFrame frame{};
  frame.exposure_over_delta = p.exposure_over_delta;
  frame.seed = p.seed, frame.frame = p.frame;
  frame.constant_xi = p.constant_xi;
  frame.stratified = p.stratified, frame.stratum_shift = p.stratum_shift;
  frame.disc = p.disc;
  frame.subsets = interleave * interleave;
  copy(p.eye, frame.eye), copy(p.right, frame.right), copy(p.up, frame.up), copy(p.forward, frame.forward);
  return frame;
}

Result<LightRangePass> LightRangePass::create(gpu::Device& device, const Settings& settings) {
  const std::vector<std::uint32_t> constants = {
      static_cast<std::uint32_t>(settings.bounds),
      settings.culling == Culling::tiled && settings.tile_test == TileTest::paper};
  const std::array<const gpu::ShaderCode*, kLightKinds> codes = {&reach_diffuse, &reach_glossy, &reach_many};
  LightRangePass pass;
  for (std::size_t kind = 0; kind < kLightKinds; ++kind) {
    Result<gpu::Kernel> kernel = gpu::Kernel::create(device, *codes[kind], sizeof(RangePush), constants);
    if (!kernel) return kernel.error();
    pass.kernels_[kind] = std::move(*kernel);
  }
  return pass;
}

void LightRangePass::record(gpu::CommandList& list, const gpu::Buffer& frame,
                            const std::array<LightsOnDevice, kLightKinds>& lights) const {
  list.begin_pass("light_range");
  for (std::size_t kind = 0; kind < kLightKinds; ++kind) {
    const LightsOnDevice& on = lights[kind];
    if (on.entries == 0) continue;
    const RangePush push{
        frame.address(), on.records->address(), on.emitters.address(), on.bounds.address(), on.entries, 0};
    list.dispatch(kernels_[kind], push, (on.entries + kThreads - 1) / kThreads);
  }
}

}  // namespace luciole
