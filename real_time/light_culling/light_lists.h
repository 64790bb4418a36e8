// SPDX-License-Identifier: Apache-2.0
// Pass: bounds of lights x parts of tiles -> the ascending list of lights of each part. Each light's proxy is taken to
// the tiles that it covers, count and all; then the lists are laid out one after the other, and filled.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/isa.h"
#include "real_time/light_culling/tile_parts.h"
#include "real_time/light_range/reaching_lights.h"

namespace luciole {

struct LightLists {
  std::vector<std::size_t> begin;      // list of part p: index[begin[p]] ... index[begin[p + 1]]
  AlignedVector<std::uint32_t> index;  // into the subset
  AlignedVector<float> covering;       // splatting: per part and lane of CellPixels, how many lights cover the pixel
  double busy_seconds = 0;             // summed over threads

  std::uint32_t length(std::uint32_t part) const { return static_cast<std::uint32_t>(begin[part + 1] - begin[part]); }
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
};

LightLists list_lights(const LightListInputs& inputs);

}  // namespace luciole
