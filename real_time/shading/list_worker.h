// SPDX-License-Identifier: Apache-2.0
// The rivals of tiled culling: all lights are listed before the first pixel is shaded, per cluster or per cell; then
// each thread walks the lists of one tile after the other.
#pragma once
#include "real_time/light_culling/light_lists.h"
#include "real_time/shading/group_shader.h"

namespace luciole {

// The lists of a frame.
class PartLists {
 public:
  explicit PartLists(const ShadingInputs& inputs);

  const TileParts& parts() const { return parts_; }
  const LightLists& diffuse() const { return diffuse_; }
  const LightLists& glossy() const { return glossy_; }
  const LightLists& many() const { return many_; }
  double busy_seconds() const;  // that culling took, summed over threads

 private:
  TileParts parts_;
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
  template <class Emitter>
  void add_lights(const ReachingLights<Emitter>& lights, const LightLists& lists, std::uint32_t subset,
                  LightCounts& added, Radiance& radiance, Radiance* part = nullptr);

  const ShadingInputs& inputs_;
  const PartLists& lists_;
  ShadingOutputs& outputs_;
  GroupShader shader_;
  ScreenTile tile_;
  float listed_[kGroupPixels];
};

}  // namespace luciole
