// SPDX-License-Identifier: Apache-2.0
// A pixel of a 16x16 tile of a sub-region. Included after the push constants, of which it reads `pixels`, `width`,
// `height` and `interleave`.
#include "real_time/shading/shading_records.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Pixels { PixelRecord value[]; };

vec3 vector(float v[3]) { return vec3(v[0], v[1], v[2]); }

struct TilePixel {
  PixelRecord record;
  uint index;  // on the screen
  bool is_surface;
};

// The tile is the workgroup's: column, row, sub-region. Its pixels are in the order of 4x4 cells, so that a subgroup's
// are neighbours.
//   i  number in the tile
TilePixel read_pixel(uint i) {
  const uint n = push.interleave, region = gl_WorkGroupID.z;
  const uint tile_x = (i / 16u % 4u) * 4u + i % 4u, tile_y = (i / 64u) * 4u + i / 4u % 4u;
  const uint x = (gl_WorkGroupID.x * 16u + tile_x) * n + region % n;
  const uint y = (gl_WorkGroupID.y * 16u + tile_y) * n + region / n;
  TilePixel pixel;
  pixel.index = min(y, push.height - 1u) * push.width + min(x, push.width - 1u);
  pixel.record = Pixels(push.pixels).value[pixel.index];
  pixel.is_surface = x < push.width && y < push.height && !isinf(pixel.record.depth);
  return pixel;
}

// Right, up, forward [m].
vec3 view_of(TilePixel pixel, float eye[3], float right[3], float up[3]) {
  const vec3 p = vector(pixel.record.position) - vector(eye);
  return vec3(dot(p, vector(right)), dot(p, vector(up)), pixel.record.depth);
}
