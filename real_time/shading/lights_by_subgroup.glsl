// SPDX-License-Identifier: Apache-2.0
// SHADE_LIGHTS of tile_loop.glsl: each invocation of a subgroup reads one light of the list and hands it to all. A light
// is read once per subgroup instead of once per pixel, but a subgroup with pixels of both halves goes through both lists.
#include "real_time/shading/emitter_words.glsl"

void shade_by_subgroup(inout ShadedPixel shaded, TilePixel pixel, TileHalves halves, SubsetRange subset,
                       uint counts[2]) {
  for (uint h = 0u; h < 2u; ++h) {
    const bool mine = pixel.is_surface && halves.half_of_pixel == h;
    if (subgroupBallot(mine) == uvec4(0u)) continue;
    for (uint first = 0u; first < counts[h]; first += gl_SubgroupSize) {
      const uint count = min(counts[h] - first, gl_SubgroupSize);
      float own[kMostUsed], w[kMostUsed];
      read_words(subset.begin + listed[h][first + min(gl_SubgroupInvocationID, count - 1u)], own);
      for (uint from = 0u; from < count; ++from) {
        words_from(from, own, w);
        if (mine) add_light_of_words(shaded, w);
      }
    }
  }
}
