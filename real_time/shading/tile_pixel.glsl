// SPDX-License-Identifier: Apache-2.0
// A pixel of a tile of a sub-region. Included after the push constants, of which it reads `pixels`, `width`, `height` and
// `interleave`.
#ifndef LUCIOLE_TILE_PIXEL_GLSL
#define LUCIOLE_TILE_PIXEL_GLSL
#include "base/vectors.glsl"
#include "real_time/shading/shading_records.h"

#ifndef TILE_SIDE
#define TILE_SIDE 16  // pixels, a multiple of 4
#endif
const uint kTileSide = TILE_SIDE;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Pixels { PixelRecord value[]; };

struct TilePixel {
  PixelRecord record;
  uint index;  // on the screen
  bool is_surface;
  vec3 view;  // view_of, for whoever asks for it
};

// Pixels are in the order of 4x4 cells, so that a subgroup's are neighbours.
//   i     number in the tile
//   tile  column, row, sub-region
TilePixel read_pixel(uint i, uvec3 tile) {
  const uint n = push.interleave, region = tile.z, cells = kTileSide / 4u;
  const uint tile_x = (i / 16u % cells) * 4u + i % 4u, tile_y = (i / (16u * cells)) * 4u + i / 4u % 4u;
  const uint x = (tile.x * kTileSide + tile_x) * n + region % n;
  const uint y = (tile.y * kTileSide + tile_y) * n + region / n;
  TilePixel pixel;
  pixel.index = min(y, push.height - 1u) * push.width + min(x, push.width - 1u);
  pixel.record = Pixels(push.pixels).value[pixel.index];
  pixel.is_surface = x < push.width && y < push.height && !isinf(pixel.record.depth);
  pixel.view = vec3(0.0);
  return pixel;
}

// Right, up, forward [m].
vec3 view_of(TilePixel pixel, float eye[3], float right[3], float up[3]) {
  const vec3 p = vector(pixel.record.position) - vector(eye);
  return vec3(dot(p, vector(right)), dot(p, vector(up)), pixel.record.depth);
}

#endif
