// SPDX-License-Identifier: Apache-2.0
// Passes culling and shading on a Vulkan device: the kernel shade_tiles.comp, once per kind of light.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "gpu/command_list.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/light_range/light_range_pass.h"
#include "real_time/settings.h"
#include "real_time/shading/shading_records.h"

namespace luciole {

// Tiles of one sub-region, and of all.
struct TileGrid {
  std::uint32_t columns, rows, regions;
  std::size_t count() const { return std::size_t(columns) * rows * regions; }
};
TileGrid tile_grid(std::uint32_t width, std::uint32_t height, std::uint32_t interleave);

// What the kernel reads and writes for one kind of light.
struct ShadingBuffers {
  const gpu::Buffer* pixels;   // PixelRecord
  const gpu::Buffer* subsets;  // SubsetRange
  const LightsOnDevice* lights;
  const gpu::Buffer* sums;               // PixelSums, per pixel
  const gpu::Buffer* tile_counts;        // TileCounts, per tile
  const gpu::Buffer* shadows = nullptr;  // ShadowRecord, where the settings want shadow rays
};

// Lights [first, first + count) of each subset.
struct LightPart {
  std::uint32_t first, count;
};

// What the kernel is told of one part of the lights of one kind.  shift: as in ShadingInputs
ShadingPush shading_push(const ShadingBuffers& buffers, const GeometryBuffer& geometry, std::uint32_t interleave,
                         std::uint32_t shift, LightPart part);

// The values of its specialisation constants.
std::vector<std::uint32_t> shading_constants(const Settings& settings, LightKind kind);

// How the lights of a tile's lists reach its pixels. The sums have the same bits. With shadow rays it is by pixel: they
// take far longer than to read a light.
enum class LightReads : std::uint8_t {
  by_pixel,    // each pixel reads each light
  by_subgroup  // each invocation of a subgroup reads another one and hands it to all; for devices that shuffle
};

// The faster of them, where it was measured: docs/results/llvmpipe/shading_variants.md.
LightReads faster_light_reads(const gpu::DeviceDescription& device);

class TileShadingPass {
 public:
  static Result<TileShadingPass> create(gpu::Device& device, const Settings& settings, LightReads reads);

  // Records one part of the lights of one kind; parts follow each other from 0 on, with a barrier between them.
  void record(gpu::CommandList& list, LightKind kind, const ShadingBuffers& buffers, const GeometryBuffer& geometry,
              std::uint32_t shift, LightPart part) const;

 private:
  std::array<gpu::Kernel, kLightKinds> kernels_;
  std::uint32_t interleave_ = 1;
};

}  // namespace luciole
