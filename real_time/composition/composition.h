// SPDX-License-Identifier: Apache-2.0
// Last pass: the parts of the light -> the picture and the layers that were asked for.
#pragma once
#include <string>
#include <vector>

#include "real_time/frame.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/shading/prediction.h"
#include "real_time/shading/shading_pass.h"

namespace luciole {

struct CompositionInputs {
  const GeometryBuffer& geometry;
  const Plane3& direct;      // radiance by the primary lights
  const Radiance& indirect;  // filtered, if a filter is on
  const Radiance& many;      // direct light of the many, likewise; its planes are empty without any
  const ShadedRadiance& shaded;
  const ShadingOutputs& counts;
  const Plane& history;          // frames in each pixel's mean; empty: one
  const Prediction& prediction;  // planes are empty unless asked for
};

const std::vector<std::string>& composition_layers();

void compose(const CompositionInputs& inputs, const std::vector<std::string>& layers, Frame& frame);

}  // namespace luciole
