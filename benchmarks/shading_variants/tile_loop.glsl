// SPDX-License-Identifier: Apache-2.0
// The loop of shade_tiles.comp with two steps that a variant may replace before it includes this:
//   LIST_LIGHTS   as list_lights: what asks the lights of a batch
//   SHADE_LIGHTS  as shade_in_turn: what adds the lists to the pixels

// Each pixel reads the lights of its list through the cache.
void shade_in_turn(inout ShadedPixel shaded, TilePixel pixel, TileHalves halves, SubsetRange subset, uint counts[2]) {
  const uint length = pixel.is_surface ? counts[halves.half_of_pixel] : 0u;
  for (uint i = 0u; i < length; ++i) add_light(shaded, subset.begin + listed[halves.half_of_pixel][i]);
}

#ifndef LIST_LIGHTS
#define LIST_LIGHTS list_lights
#endif
#ifndef SHADE_LIGHTS
#define SHADE_LIGHTS shade_in_turn
#endif

//   tile, tiles  as in write_counts
void shade_tile(uvec3 tile, uvec3 tiles, TilePixel pixel, TileHalves halves) {
  uint lights_of_half[2] = uint[2](0u, 0u);
  ShadedPixel shaded = start_pixel(pixel.record);
  const SubsetRange subset = subset_of(tile.z);
  const SidePlanes sides = side_planes(halves.tile);
  const bool any_surface = halves.pixels[0] + halves.pixels[1] > 0u;
  for (uint batch = 0u; any_surface && batch < subset.count; batch += kBatch) {
    uint counts[2] = uint[2](0u, 0u);
    LIST_LIGHTS(subset, batch, min(subset.count, batch + kBatch), halves, sides, counts);
    SHADE_LIGHTS(shaded, pixel, halves, subset, counts);
    lights_of_half[0] += halves.pixels[0] > 0u ? counts[0] : 0u;
    lights_of_half[1] += halves.pixels[1] > 0u ? counts[1] : 0u;
    barrier();  // the next batch writes the lists anew
  }
  write_counts(tile, tiles, halves, lights_of_half, shaded.accepted, any_surface ? subset.count : 0u);
  write_sums(pixel, shaded, lights_of_half[halves.half_of_pixel]);
}
