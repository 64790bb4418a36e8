// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_range/subset_layout.h"

namespace luciole {

SubsetLayout subset_layout(const AlignedVector<std::uint32_t>& key, std::uint32_t interleave) {
  const std::uint32_t subsets = interleave * interleave;
  SubsetLayout layout;
  layout.begin.resize(subsets), layout.count.resize(subsets);
  for (const std::uint32_t k : key) ++layout.count[k % subsets];
  std::uint32_t entries = 0;
  for (std::uint32_t s = 0; s < subsets; ++s) {
    layout.begin[s] = entries;
    entries += (layout.count[s] + 15) / 16 * 16;
  }
  layout.light.assign(entries, kNoLight);
  std::vector<std::uint32_t> next = layout.begin;
  for (std::uint32_t i = 0; i < key.size(); ++i) layout.light[next[key[i] % subsets]++] = i;
  return layout;
}

}  // namespace luciole
