// SPDX-License-Identifier: Apache-2.0
// The bilateral filter once more for its tests: one tap at a time, in double, from positions instead of inverse depths,
// with the mistakes built in that the tests must catch.
#pragma once
#include "real_time/filtering/filter_radius.h"
#include "real_time/shading/radiance.h"

namespace luciole {

struct ReferenceFilter {
  FilterRadius radius{8, 8};
  double end_weight = 0.5;       // right for interleaving; 1 leaves a period of 8 pixels
  bool guided = true;            // false: a blur that knows nothing of surfaces
  bool divide_by_weight = true;  // false: by the number of taps, which darkens at edges and borders
};

struct ReferenceLight {
  Radiance light;
  Radiance rounding;  // by how much float arithmetic may differ, to first order, per pixel and channel
};
ReferenceLight filter_by_definition(const ReferenceFilter& filter, const GeometryBuffer& geometry,
                                    const Radiance& noisy);

}  // namespace luciole
