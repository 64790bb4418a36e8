// SPDX-License-Identifier: Apache-2.0
// The rivals of tiled culling: all lights are listed before the first pixel is shaded; then each thread takes the lists
// of one tile after the other apart, per cluster or per cell, and walks them.
#pragma once
#include "real_time/light_culling/light_lists.h"
#include "real_time/shading/group_shader.h"

namespace luciole {

// The lists of a window of the frame.
class PartLists {
 public:
  PartLists(const ShadingInputs& inputs, const TileParts& parts, const TileWindow& window);

  bool complete() const { return diffuse_.complete && glossy_.complete && many_.complete; }
  const TileParts& parts() const { return parts_; }
  const LightLists& diffuse() const { return diffuse_; }
  const LightLists& glossy() const { return glossy_; }
  const LightLists& many() const { return many_; }
  double busy_seconds() const;  // that culling took, summed over threads
  std::size_t bytes() const { return diffuse_.bytes + glossy_.bytes + many_.bytes; }

 private:
  const TileParts& parts_;
  LightLists diffuse_, glossy_, many_;
};

class ListWorker {
 public:
  ListWorker(const ShadingInputs& inputs, const PartLists& lists, ShadingOutputs& outputs)
      : inputs_(inputs), lists_(lists), outputs_(outputs), shader_(inputs, outputs) {}

  // All tiles of one 16n x 16n block of pixels.
  void run_block(std::uint32_t bx, std::uint32_t by);

  ShadingCounts counts;  // of this thread

 private:
  // What the tile's pixels see, all of it in one subset.
  struct TileSeen {
    std::uint32_t tile, subset;
  };
  template <class Emitter>
  void add_lights(const ReachingLights<Emitter>& lights, const LightLists& lists, TileSeen seen, LightCounts& added,
                  Radiance& radiance, Radiance* part = nullptr);
  // The lists of the tile's parts, one after the other.
  void list_parts(const LightLists& lists, std::uint32_t tile);

  const ShadingInputs& inputs_;
  const PartLists& lists_;
  ShadingOutputs& outputs_;
  GroupShader shader_;
  ScreenTile tile_;
  AlignedVector<std::uint32_t> index_;
  std::vector<std::size_t> part_begin_;  // list of the tile's p-th part: [part_begin_[p], part_begin_[p + 1])
  float listed_[kGroupPixels];
};

}  // namespace luciole
