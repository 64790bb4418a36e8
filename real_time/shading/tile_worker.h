// SPDX-License-Identifier: Apache-2.0
// What one thread needs to cull and shade one tile after the other: memory that is reused, and counts.
#pragma once
#include <vector>

#include "base/isa.h"
#include "real_time/light_culling/cull_kernel.h"
#include "real_time/light_culling/tile.h"
#include "real_time/shading/group_shader.h"

namespace luciole {

// What the tile test asks of a tile: slopes that hold both halves, and each half's depths.
TileFrustum frustum_of(const ScreenTile& tile);

// The lists of one tile half, and the memory behind them.
class ListMemory {
 public:
  TouchingLights& reserve(std::size_t lights);  // room for a whole subset
  TouchingLights& lists() { return lists_; }

 private:
  AlignedVector<std::uint32_t> index_;
  AlignedVector<float> rows_[TouchingLights::kRows];
  TouchingLights lists_{};
};

class TileWorker {
 public:
  TileWorker(const ShadingInputs& inputs, ShadingOutputs& outputs)
      : inputs_(inputs), outputs_(outputs), shader_(inputs, outputs) {}

  // All tiles of one 16n x 16n block of pixels.
  void run_block(std::uint32_t bx, std::uint32_t by);

  ShadingCounts counts;  // of this thread

 private:
  template <class Emitter>
  void add_lights(const ReachingLights<Emitter>& lights, std::uint32_t subset, LightCounts& added, Radiance& radiance,
                  Radiance* part = nullptr);
  template <class Emitter>
  void list_lights(const ReachingLights<Emitter>& lights, std::uint32_t subset, LightCounts& added);
  // The lists of all groups one after the other, as indices into the subset.
  void list_lights_of_groups(std::uint32_t subset_lights, LightCounts& added);

  const ShadingInputs& inputs_;
  ShadingOutputs& outputs_;
  GroupShader shader_;
  ScreenTile tile_;
  ListMemory halves_[2];
  AlignedVector<std::uint32_t> group_lists_;
  std::vector<std::uint32_t> group_begin_;  // list of group g: [group_begin_[g], group_begin_[g + 1])
  float listed_[kGroupPixels];
};

}  // namespace luciole
