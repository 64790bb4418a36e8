// SPDX-License-Identifier: Apache-2.0
// The depth slices of a frame, of which cluster_slices.h tells; the text follows it. Included after the push constants,
// of which it reads `depths`.
#include "real_time/light_culling/list_records.h"

const uint kSlices = 32u;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Depths { uint value[2]; };

struct ClusterSlices {
  uint first_bits, step;
};

bool shows_a_surface() { return Depths(push.depths).value[1] != 0u; }

//   shows_a_surface()
ClusterSlices read_slices() {
  const uint first = ~Depths(push.depths).value[0], last = Depths(push.depths).value[1];
  return ClusterSlices(first, (last - first) / kSlices + 1u);
}

uint cluster_slice_of(ClusterSlices slices, float depth) {
  const uint bits = floatBitsToUint(depth);
  return bits < slices.first_bits ? 0u : min((bits - slices.first_bits) / slices.step, kSlices - 1u);
}

float depth_of_slice(ClusterSlices slices, uint slice) {
  return uintBitsToFloat(slices.first_bits + slice * slices.step);
}
