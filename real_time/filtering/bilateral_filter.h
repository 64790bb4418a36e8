// SPDX-License-Identifier: Apache-2.0
// Door: noisy light in, clean light out. The cross bilateral filter of [TH17] section 6 over normal, depth and
// material.
#pragma once
#include <cstdint>

#include "real_time/filtering/filter_radius.h"
#include "real_time/settings.h"
#include "real_time/shading/radiance.h"

namespace luciole {

// The footprint that averages n x n interleaved pixels evenly must be a multiple of n. 8, [TH17]'s radius, serves n =
// 1, 2, 4 and 8: smaller n needs less for its pattern, but roulette noise stays, and at 1280x720 no smaller radius has
// a smaller error (docs/decisions/filter.md). For other n, the largest multiple up to 8.
FilterRadius filter_radius(std::uint32_t interleave);

// Where the samples of pixels lie, as the weights need it (FilterPicture).
struct FilterView {
  float footprint, left_edge, top_edge;
};
FilterView filter_view(const GeometryBuffer& geometry);

class BilateralFilterPass {
 public:
  struct Inputs {
    const GeometryBuffer& geometry;
    const Radiance& noisy;    // of the size of the geometry, or all planes empty
    FilterRadius radius;      // filter_radius(interleave)
    Isa isa = Isa::baseline;  // what choose_isa gave
  };
  // Every pixel becomes the weighted mean of its neighbours' demodulated light (bilateral_weight.h, demodulation.h).
  // - The sky, pixels outside the picture and light that is not finite take no part; sky keeps its own value.
  // - The same bits for any number of threads. Light that is constant over like surfaces stays constant.
  // The planes are this object's until the next run: frame after frame they need no new memory.
  const Radiance& run(const Inputs& inputs);

 private:
  Radiance clean_;
};

}  // namespace luciole
