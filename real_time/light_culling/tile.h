// SPDX-License-Identifier: Apache-2.0
// The unit of work of culling and shading: a 16x16 tile of one sub-region of the interleaved screen, that is every n-th
// pixel of a 16n x 16n block. Its pixels are split into two depth halves (Modified HalfZ, [TH17] §5.1), each with its
// own tight depth range and slopes, and then into groups of 16 for the kernels.
#pragma once
#include <cstdint>
#include <vector>

#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/shading/pixel_group.h"

namespace luciole {

inline constexpr std::uint32_t kTileSide = 16;  // pixels of a sub-region
inline constexpr std::uint32_t kTilePixels = kTileSide * kTileSide;

// The frustum piece that holds one depth half: slopes are right/forward and up/forward in view space.
struct TileHalf {
  std::uint32_t pixels = 0;
  float x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // slopes
  float z0 = 0, z1 = 0;                  // depth along forward [m], > 0
};

struct ScreenTile {
  TileHalf half[2];                // near, far; far is empty where the tile shows one flat piece
  std::vector<PixelGroup> groups;  // near ones first
  std::uint32_t group_count = 0;
};

struct TilePixel {
  std::uint32_t pixel;  // row-major index in the screen
  std::uint32_t cell;   // of 4x4 pixels, row-major in the tile: 0 ... 15
  Vec3 view;            // right, up, forward [m]
};

// The pixels of a tile that show a surface, cell by cell.
struct PixelList {
  TilePixel entries[kTilePixels];
  std::uint32_t count = 0;
};

// Which pixels a tile has: block (bx, by) of 16n x 16n pixels, sub-region (sx, sy) in [0, n)^2.
struct TileAddress {
  std::uint32_t interleave;  // n
  std::uint32_t bx, by, sx, sy;
};

void list_pixels(const GeometryBuffer& geometry, const TileAddress& address, PixelList& list);

// Adds `count` pixels to the tile as groups of 16.
//   part  PixelGroup::part
void append_groups(const GeometryBuffer& geometry, const TilePixel* pixels, std::uint32_t count, std::uint32_t part,
                   ScreenTile& tile);

// Reads a tile's pixels; those without a surface are left out. Reuses the memory of `tile`.
void read_tile(const GeometryBuffer& geometry, const TileAddress& address, ScreenTile& tile);

}  // namespace luciole
