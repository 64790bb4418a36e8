// SPDX-License-Identifier: Apache-2.0
// Pass: bounds of lights x parts of tiles -> the ascending list of lights of each tile, with a bit per part that the
// light reaches. Each light's proxy is taken to the tiles that it covers, once; then the lists are laid out one after
// the other, as long as they are, and filled. Lists of single parts live only as long as their tile is shaded: written
// out for the whole frame they took several times the memory (docs/decisions/rivals.md).
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/isa.h"
#include "real_time/light_culling/tile_parts.h"
#include "real_time/light_range/reaching_lights.h"

namespace luciole {

struct LightLists {
  bool complete = true;  // false: longer than allowed; nothing is listed
  // Of all sub-regions' tiles (TileParts::tile); those outside the window have none. Tile t: [begin[t], begin[t + 1])
  std::vector<std::size_t> begin;
  AlignedVector<std::uint32_t> light;  // index in the subset
  AlignedVector<std::uint32_t> parts;  // bits, as in TileParts::occupied
  AlignedVector<float> covering;       // splatting: per part and lane of CellPixels, how many lights cover the pixel
  std::uint64_t tests = 0;             // that the proxy kernels made
  double busy_seconds = 0;             // summed over threads
  std::size_t bytes = 0;               // at most in use at once, what is gone by now included
};

// The bounds of the lights that one sub-region sees.
struct SubsetBounds {
  const BoundBlock* blocks;
  std::uint32_t count;  // lights; the last block may be partly used
};

struct LightListInputs {
  const GeometryBuffer& geometry;
  const TileParts& parts;
  std::vector<SubsetBounds> bounds;  // per sub-region
  std::uint32_t interleave;
  Culling culling;  // clustered or splatting
  TileTest test;    // paper: the proxies alone; else no part that the surface of the light hides, and no cluster that
                    // fails the test
  Isa isa;
  TileWindow window;
  std::size_t most_entries;  // pairs of light and tile; a single block of tiles may have more
};

LightLists list_lights(const LightListInputs& inputs);

}  // namespace luciole
