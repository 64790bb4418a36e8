// SPDX-License-Identifier: Apache-2.0
#include <set>
#include <vector>

#include "equations/test_support.h"

namespace luciole::test {

TEST(Interleaving, gives_each_pixel_of_an_n_by_n_block_its_own_sub_region) {
  for (std::uint32_t log2_n : {0u, 1u, 2u, 3u}) {
    const std::uint32_t n = 1u << log2_n;
    std::set<std::uint32_t> regions;
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        regions.insert(f32::sub_region_of_pixel(x + 5 * n, y + 3 * n, log2_n));
        EXPECT_EQ(f32::sub_region_of_pixel(x, y, log2_n), y * n + x);
      }
    EXPECT_EQ(regions.size(), n * n);
    EXPECT_EQ(f32::interleaving_weight(log2_n), static_cast<float>(n * n));
  }
  EXPECT_NE(f32::interleaving_weight(3), 63.0f);
}

TEST(Interleaving, sees_every_light_once_per_block_and_every_subset_over_frames) {
  const std::uint32_t log2_n = 3, shift = 0xdeadbeefu;
  std::set<std::uint32_t> subsets;
  for (std::uint32_t s = 0; s < 64; ++s) subsets.insert(f32::light_subset(s, shift, log2_n));
  EXPECT_EQ(subsets.size(), 64u);
  EXPECT_EQ(*subsets.rbegin(), 63u);
  std::vector<double> visits(64, 0.0);
  const int frames = 64000;
  for (std::uint32_t frame = 0; frame < frames; ++frame)
    visits[f32::light_subset(17, f32::random_words(9, frame, 0, 5).first, log2_n)] += 1;
  double chi = 0;
  for (double v : visits) chi += (v - 1000) * (v - 1000) / 1000;
  EXPECT_LT(std::abs(chi - 63) / std::sqrt(126.0), kSigmas);
  std::set<std::uint32_t> fixed;
  for (int frame = 0; frame < 100; ++frame) fixed.insert(f32::light_subset(17, 0, log2_n));
  EXPECT_EQ(fixed.size(), 1u) << "without a shift a pixel would see one subset for ever";
}

}  // namespace luciole::test
