// SPDX-License-Identifier: Apache-2.0
// Pass: geometry buffer x reaching lights -> noisy radiance. Tiled culling and shading go together, tile by tile, so
// that a light list lives only as long as its tile is in the cache ([TH17] §6). The rivals list all lights of a window
// first, which is the whole frame unless its lists are too long.
#pragma once
#include <cstdint>

#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/light_range/reaching_lights.h"
#include "real_time/settings.h"
#include "real_time/shading/radiance.h"

namespace luciole {

class RayScene;

struct ShadingInputs {
  const GeometryBuffer& geometry;
  const ReachingLights<DiffuseEmitter>& diffuse;
  const ReachingLights<GlossyEmitter>& glossy;
  const ReachingLights<ManyEmitter>& many;
  const Settings& settings;           // culling, tile test, ranges, interleave, resolved isa
  std::uint32_t shift = 0;            // subset of sub-region s: (s + shift) mod n^2
  const RayScene* shadows = nullptr;  // one shadow ray per accepted one of `many`, if given
  bool count_per_pixel = false;       // fill lights_listed and lights_false
  bool lobes_apart = false;           // fill from_diffuse and from_glossy
  // Pairs of light and tile that the rivals of tiled culling list at once, per kind: 20 bytes each and room to grow,
  // half a GiB. A frame that has more is listed and shaded window by window.
  std::size_t most_entries = std::size_t(1) << 24;
};

// Counts of one kind of lobe. A list belongs to one depth half of one tile, or to one cluster; splatting gives lights
// to single pixels, and its lists are those of cells of 4x4 pixels.
struct LightCounts {
  // Made by culling. Tiled: a light against a tile, both halves at once, or against a group of 16 pixels. The rivals:
  // see proxy_kernel.h.
  std::uint64_t tests = 0;
  std::uint64_t listed = 0;     // light x pixel pairs that culling left
  std::uint64_t evaluated = 0;  // pairs that went through the shading kernel, 16 lanes a group
  std::uint64_t accepted = 0;   // p > xi
};

struct ShadingCounts {
  LightCounts diffuse, glossy, many;
  std::vector<std::uint32_t> list_lengths;          // all lists, diffuse and glossy and many, unordered
  std::uint64_t pixels = 0;                         // with a surface
  double culling_seconds = 0, shading_seconds = 0;  // summed over threads; reading pixels counts as shading

  void add(const ShadingCounts& more);
};

struct ShadingOutputs : ShadingCounts {
  ShadedRadiance radiance;
  Plane lights_listed, lights_false;  // per pixel, all kinds; empty unless asked for
  // Of the rivals of tiled culling: what their lists of the longest window took [bytes], and how many windows.
  std::size_t list_bytes = 0, windows = 0;
};

ShadingOutputs shade(const ShadingInputs& inputs);

}  // namespace luciole
