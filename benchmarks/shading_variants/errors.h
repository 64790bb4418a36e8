// SPDX-License-Identifier: Apache-2.0
// How far a variant's light is from that in double precision.
#pragma once
#include <cstddef>
#include <vector>

#include "benchmarks/shading_variants/device_stage.h"
#include "real_time/double_reference.h"

namespace luciole {

class DoubleReference {
 public:
  //   vpls         those of the stage
  //   most_pixels  at how many pixels, evenly spread: double precision asks every light at each
  DoubleReference(const DeviceStage& stage, const VirtualPointLights& vpls, std::size_t most_pixels);

  // Median, over the pixels that are lit, at no tie, and shine (f0 > 0: there precision of the BRDF matters), of the
  // error of diffuse * albedo + specular, relative to the largest channel.
  //   sums  of both lobes of virtual point lights, in the order of the kinds
  double median_error(const std::vector<std::vector<PixelSums>>& sums) const;

 private:
  const DeviceStage& stage_;
  std::vector<test::DoublePixel> right_;
};

}  // namespace luciole
