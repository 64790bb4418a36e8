// SPDX-License-Identifier: Apache-2.0
// Which light stands where: ordered by interleaving subset, for both engines.
#pragma once
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"

namespace luciole {

inline constexpr std::uint32_t kNoLight = 0xffffffffu;

// Subset s holds the entries [begin[s], begin[s] + count[s]); begin is a multiple of 16.
struct SubsetLayout {
  std::vector<std::uint32_t> begin, count;
  std::vector<std::uint32_t> light;  // per entry, its place in the pass's input; kNoLight between the subsets
};

// A light stands in subset key mod n^2, in the order of the input. The subset is that of the key, never of the place in
// a compacted list: a light that is lost elsewhere must not move all others to other pixels.
SubsetLayout subset_layout(const AlignedVector<std::uint32_t>& key, std::uint32_t interleave);

}  // namespace luciole
