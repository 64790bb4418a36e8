// SPDX-License-Identifier: Apache-2.0
// 32 depth slices between the nearest and the farthest surface of a frame, each about as many times as deep as the one
// before: equal steps of the bits of a float, which are its logarithm drawn with straight lines. Bits keep order, so a
// depth within a range is never outside the range's slices.
#pragma once
#include <cstdint>

namespace luciole {

struct ClusterSlices {
  static constexpr std::uint32_t kCount = 32;
  std::uint32_t first_bits = 0;  // of the nearest depth
  std::uint32_t step = 1;        // bits per slice, >= 1
};

// Internal linkage: kernels of all instruction sets include this.
static inline std::uint32_t depth_bits(float depth) {
  std::uint32_t bits;
  __builtin_memcpy(&bits, &depth, sizeof(bits));
  return bits;
}

//   0 < nearest <= farthest < infinity  [m]
static inline ClusterSlices cluster_slices_between(float nearest, float farthest) {
  const std::uint32_t first = depth_bits(nearest);
  return {first, (depth_bits(farthest) - first) / ClusterSlices::kCount + 1};
}

//   depth >= 0  [m]
//   returns     0 ... 31
static inline std::uint32_t cluster_slice_of(const ClusterSlices& slices, float depth) {
  const std::uint32_t bits = depth_bits(depth);
  const std::uint32_t slice = bits < slices.first_bits ? 0 : (bits - slices.first_bits) / slices.step;
  return slice < ClusterSlices::kCount ? slice : ClusterSlices::kCount - 1;
}

// Where a slice begins [m].
static inline float depth_of_slice(const ClusterSlices& slices, std::uint32_t slice) {
  const std::uint32_t bits = slices.first_bits + slice * slices.step;
  float depth;
  __builtin_memcpy(&depth, &bits, sizeof(depth));
  return depth;
}

}  // namespace luciole
