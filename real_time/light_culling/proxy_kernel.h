// SPDX-License-Identifier: Apache-2.0
// Which tiles the proxy of a light covers, and there which clusters or cells. Nothing is clipped at a near plane, and
// the eye may be inside.
#pragma once
#include <cstdint>

#include "real_time/light_culling/cluster_slices.h"
#include "real_time/light_culling/sphere_proxy.h"
#include "real_time/light_range/reaching_lights.h"
#include "real_time/settings.h"
#include "real_time/shading/pixel_group.h"

namespace luciole {

// Tiles [column_begin, column_end) x [row_begin, row_end) of each sub-region.
struct TileWindow {
  std::uint32_t column_begin, column_end, row_begin, row_end;
};

// A window of the tiles of one sub-region. Borders between tiles lie halfway between the pixels on either side.
struct TileBand {
  float x_first, x_step;  // slope right/forward of the border left of column c: x_first + c * x_step
  float y_first, y_step;  // slope up/forward of the border above row r: y_first + r * y_step, y_step < 0
  TileWindow window;
  std::uint32_t columns;          // of the sub-region
  const std::uint32_t* occupied;  // per tile of the sub-region, row by row (TileParts)
  const std::uint32_t* first;
  ClusterSlices slices;  // of all surfaces
  TileTest test;         // LightListInputs
};

// What splatting asks of the pixels of a cell. The depth of lanes without a pixel is no number: no test passes.
struct alignas(64) CellPixels {
  float x[kGroupPixels], y[kGroupPixels];  // slopes right/forward and up/forward
  float depth[kGroupPixels];               // [m]
};

// Per part of the sub-regions (TileParts).
struct SplatCells {
  const CellPixels* pixels;
  const float* nearest;  // least depth of the cell's pixels [m]
};

// Parts of a tile that a light's proxy covers.
struct LightSpan {
  std::uint32_t light;  // in the subset
  std::uint32_t tile;   // of the sub-region
  std::uint32_t parts;  // bits, as in TileParts::occupied, never 0
};

// Depths of a proxy in each tile of a window, column by column: memory for the window's tiles.
struct TileDepths {
  float *low, *high;  // [m]
};

// Declares, in the namespace of one instruction set, what takes the up to 16 lights of a block to the tiles of a
// window. Both write spans in ascending order of lights, at most 16 per tile of the window, and return how many.
//   cluster_lights  by conservative rasterisation of an icosahedron
//   splat_lights    by rasterisation of the back of a geodesic sphere, where it lies behind the pixel's surface
//     covering  per part and lane; each covered pixel's is raised by 1
//   tests  raised by the tests made: a light's triangles are one each, then every tile of its rectangle, or every
//          triangle in every cell that it may cover
#define LUCIOLE_DECLARE_PROXY_KERNELS(isa)                                                                           \
  namespace luciole::isa {                                                                                           \
  std::uint32_t cluster_lights(const BoundBlock& block, std::uint32_t first_light, const TileBand& band,             \
                               const IcosahedronProxy& proxy, const TileDepths& depths, LightSpan* spans,            \
                               std::uint64_t& tests);                                                                \
  std::uint32_t splat_lights(const BoundBlock& block, std::uint32_t first_light, const TileBand& band,               \
                             const GeodesicProxy& proxy, const SplatCells& cells, float* covering, LightSpan* spans, \
                             std::uint64_t& tests);                                                                  \
  }
}  // namespace luciole
LUCIOLE_DECLARE_PROXY_KERNELS(avx512)
LUCIOLE_DECLARE_PROXY_KERNELS(avx2)
LUCIOLE_DECLARE_PROXY_KERNELS(baseline)
#undef LUCIOLE_DECLARE_PROXY_KERNELS
