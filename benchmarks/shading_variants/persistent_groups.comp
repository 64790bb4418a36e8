// SPDX-License-Identifier: Apache-2.0
// Fewer workgroups than tiles: each takes the next tile from a counter until there is none.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "benchmarks/shading_variants/variant.glsl"
#include "real_time/shading/tile_loop.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counter { uint taken; };

shared uint next;

void main() {
  const uint side = kTileSide * push.interleave;
  const uvec3 tiles = uvec3((push.width + side - 1u) / side, (push.height + side - 1u) / side,
                            push.interleave * push.interleave);
  for (uint turn = 0u; turn < tiles_each; ++turn) {
    if (thread() == 0u) next = atomicAdd(Counter(more).taken, 1u);
    barrier();
    const uint place = next;
    barrier();
    if (place >= tiles.x * tiles.y * tiles.z) break;
    const uvec3 tile = uvec3(place % tiles.x, place / tiles.x % tiles.y, place / (tiles.x * tiles.y));
    const TilePixel pixel = read_pixel(tile);
    shade_tile(tile, tiles, pixel, halve(pixel));
  }
}
