// SPDX-License-Identifier: Apache-2.0
// The rivals of tiled culling on a Vulkan device: the kernels light_culling/find_*.comp, which find the clusters or
// cells that show a surface, mark_*.comp, which take each light's proxy to them, and shade_lists.comp, which walks the
// lists. A list is a bit per light of a window; windows follow each other.
#pragma once
#include "real_time/light_culling/list_records.h"
#include "real_time/light_culling/sphere_proxy.h"
#include "real_time/shading/shading_pass.h"
#include "real_time/shading/tile_shading_pass.h"

namespace luciole {

struct SphereProxies {
  IcosahedronProxy icosahedron = circumscribed_icosahedron();
  GeodesicProxy geodesic = circumscribed_geodesic();
};

class ListShadingPass {
 public:
  //   settings  culling: clustered or splatting
  //   proxies   others: for tests
  static Result<ListShadingPass> create(gpu::Device& device, const Settings& settings,
                                        const SphereProxies& proxies = {});

  // Memory for frames of a size, kept where it is enough. Before each frame, ahead of what is recorded.
  //   longest  of the subsets of all kinds of light, which tells how long a window is worth being
  Status reserve(gpu::Device& device, std::uint32_t width, std::uint32_t height, std::uint32_t longest);

  // Records what all kinds of light share, a function of the pixels: once per view, or per frame.
  //   pixels  PixelRecord
  void record_parts(gpu::CommandList& list, const gpu::Buffer& pixels, const GeometryBuffer& geometry) const;

  // As TileShadingPass::record, and with the barriers that it needs between its own kernels; tile_counts has a
  // PartCounts per tile. A part costs four commands per window: its count should be no more than the longest subset
  // has.
  void record(gpu::CommandList& list, LightKind kind, const ShadingBuffers& buffers, const GeometryBuffer& geometry,
              std::uint32_t shift, LightPart part) const;

  // The two halves of record(), for tests.  part: a window
  void record_lists(gpu::CommandList& list, const ShadingBuffers& buffers, const GeometryBuffer& geometry,
                    std::uint32_t shift, LightPart part) const;
  void record_sums(gpu::CommandList& list, LightKind kind, const ShadingBuffers& buffers,
                   const GeometryBuffer& geometry, std::uint32_t shift, LightPart part) const;

  std::uint32_t window() const { return 32 * words_; }  // lights of a subset that are listed at once
  std::uint32_t words() const { return words_; }        // of a list
  std::uint32_t parts_per_tile() const { return clusters_ ? 32 : 16; }
  const gpu::Buffer& lists() const { return lists_; }  // words() words per part
  std::uint64_t bytes() const;                         // of what reserve() keeps

 private:
  bool clusters_ = true;
  std::uint32_t interleave_ = 1, words_ = 1;
  gpu::Kernel find_depths_, find_parts_, mark_;
  std::array<gpu::Kernel, kLightKinds> shade_;
  gpu::Buffer staged_proxy_, proxy_;
  gpu::Buffer depths_, occupied_, cells_, lists_, covering_;
};

// Adds what the lights of one kind came to to their counts and to the lengths of lists, of which the pass's `counts`
// are those of `tiles` tiles.
void add_part_counts(const PartCounts* counts, std::size_t tiles, LightCounts& to,
                     std::vector<std::uint32_t>& list_lengths);

}  // namespace luciole
