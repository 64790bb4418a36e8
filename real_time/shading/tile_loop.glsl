// SPDX-License-Identifier: Apache-2.0
// A tile from its lights to its sums, in two steps that whoever includes this may replace by another of the same
// parameters:
//   LIST_LIGHTS   asks the lights of a batch (list_lights of tile_lists.glsl)
//   SHADE_LIGHTS  adds the lists to the pixels (here shade_by_pixel; lights_by_subgroup.glsl has another)

// Each pixel reads the lights of its list for itself.
void shade_by_pixel(inout ShadedPixel shaded, TilePixel pixel, TileHalves halves, SubsetRange subset, uint counts[2]) {
  const uint length = pixel.is_surface ? counts[halves.half_of_pixel] : 0u;
  for (uint i = 0u; i < length; ++i) add_light(shaded, subset.begin + listed[halves.half_of_pixel][i]);
}

#ifndef LIST_LIGHTS
#define LIST_LIGHTS list_lights
#endif
#ifndef SHADE_LIGHTS
#define SHADE_LIGHTS shade_by_pixel
#endif

// Lights [first_light, first_light + light_count) of the tile's subset.
//   tile, tiles  as in write_counts
void shade_tile(uvec3 tile, uvec3 tiles, TilePixel pixel, TileHalves halves) {
  uint lights_of_half[2] = uint[2](0u, 0u);
  ShadedPixel shaded = start_pixel(pixel.record);
  if (push.first_light > 0u && pixel.is_surface) take_earlier_sums(shaded, pixel.index);
  const SubsetRange subset = subset_of(tile.z);
  const uint end = min(subset.count, push.first_light + push.light_count);
  const SidePlanes sides = side_planes(halves.tile);
  const bool any_surface = halves.pixels[0] + halves.pixels[1] > 0u;
  for (uint batch = push.first_light; any_surface && batch < end; batch += kBatch) {
    uint counts[2] = uint[2](0u, 0u);
    LIST_LIGHTS(subset, batch, min(end, batch + kBatch), halves, sides, counts);
    SHADE_LIGHTS(shaded, pixel, halves, subset, counts);
    lights_of_half[0] += halves.pixels[0] > 0u ? counts[0] : 0u;
    lights_of_half[1] += halves.pixels[1] > 0u ? counts[1] : 0u;
    barrier();  // the next batch writes the lists anew
  }
  write_counts(tile, tiles, halves, lights_of_half, shaded.accepted, any_surface && kCulled != 0u ? end : 0u);
  write_sums(pixel, shaded, lights_of_half[halves.half_of_pixel]);
}
