// SPDX-License-Identifier: Apache-2.0
// Door: noisy light in, clean light out. The cross bilateral filter of [TH17] section 6 over normal, depth and
// material.
#pragma once
#include <cstdint>

#include "real_time/filtering/filter_tile.h"
#include "real_time/settings.h"
#include "real_time/shading/radiance.h"

namespace luciole {

// The footprint that averages n x n interleaved pixels evenly: a multiple of n. [TH17] has radius 8 for n = 8; smaller
// n would allow less, but roulette noise stays, and 8 is measured best for each of them (docs/results/filter.md).
FilterRadius filter_radius(std::uint32_t interleave);

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
