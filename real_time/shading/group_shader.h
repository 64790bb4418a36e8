// SPDX-License-Identifier: Apache-2.0
// Where all ways of culling meet: a list of lights is added to a group of pixels by the one shading kernel, and
// counted.
#pragma once
#include <vector>

#include "real_time/shading/shade_kernel.h"
#include "real_time/shading/shading_pass.h"

namespace luciole {

class GroupShader {
 public:
  GroupShader(const ShadingInputs& inputs, ShadingOutputs& outputs) : inputs_(inputs), outputs_(outputs) {}

  //   listed         per lane, how many lights culling left to the pixel
  //   counts         of this kind of lobe
  //   radiance, part what the light is added to; part may be null
  template <class Emitter>
  void add(const PixelGroup& group, LightList<Emitter> list, const float (&listed)[kGroupPixels], LightCounts& counts,
           Radiance& radiance, Radiance* part);

 private:
  void find_shadows(const PixelGroup& group, LightList<ManyEmitter>& list);
  void find_shadows(const PixelGroup&, LightList<DiffuseEmitter>&) {}
  void find_shadows(const PixelGroup&, LightList<GlossyEmitter>&) {}
  void add_to_pixels(const PixelGroup& group, Radiance& radiance) const;
  void count(const PixelGroup& group, const float (&listed)[kGroupPixels], LightCounts& counts);

  const ShadingInputs& inputs_;
  ShadingOutputs& outputs_;
  std::vector<std::uint16_t> visible_;
  GroupRadiance sum_;
};

}  // namespace luciole
