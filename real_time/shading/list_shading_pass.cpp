// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/list_shading_pass.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "real_time/light_culling/tile.h"

namespace luciole {

extern const gpu::ShaderCode find_depths;
extern const gpu::ShaderCode find_parts;
extern const gpu::ShaderCode mark_clusters;
extern const gpu::ShaderCode mark_splats;
extern const gpu::ShaderCode shade_lists;
extern const gpu::ShaderCode shade_lists_with_shadows;

namespace {

// What lists may take [bytes], unless a word of each takes more, and the most words of one: counts of covered pixels
// have 16 bits.
constexpr std::uint64_t kMostBytes = std::uint64_t(64) << 20;
constexpr std::uint32_t kMostWords = 32;

// Rows of tiles that a workgroup of mark_clusters.comp and of mark_splats.comp takes.
constexpr std::uint32_t kRowsOfClusters = 32, kRowsOfSplats = 4;

void copy(Vec3 from, float (&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

Status make(gpu::Device& device, const gpu::ShaderCode& code, std::uint32_t push_bytes,
            const std::vector<std::uint32_t>& constants, gpu::Kernel& made) {
  Result<gpu::Kernel> kernel = gpu::Kernel::create(device, code, push_bytes, constants);
  if (!kernel) return kernel.error();
  made = std::move(*kernel);
  return Done{};
}

template <class Proxy>
Status place(gpu::Device& device, const Proxy& proxy, gpu::Buffer& staged, gpu::Buffer& placed) {
  Result<gpu::Buffer> upload = gpu::Buffer::create(device, sizeof(Proxy), gpu::BufferUse::upload);
  if (!upload) return upload.error();
  std::memcpy(upload->as<void>(), &proxy, sizeof(Proxy));
  staged = std::move(*upload);
  return gpu::grow(device, placed, sizeof(Proxy), gpu::BufferUse::device);
}

}  // namespace

Result<ListShadingPass> ListShadingPass::create(gpu::Device& device, const Settings& settings,
                                                const SphereProxies& proxies) {
  ListShadingPass pass;
  pass.clusters_ = settings.culling == Culling::clustered, pass.interleave_ = settings.interleave;
  const std::uint32_t clusters = pass.clusters_, test = static_cast<std::uint32_t>(settings.tile_test);
  const std::uint32_t divide_by_p = settings.ranges == Ranges::stochastic;
  Status made = make(device, find_depths, sizeof(PartPush), {}, pass.find_depths_);
  if (made) made = make(device, find_parts, sizeof(PartPush), {clusters}, pass.find_parts_);
  const gpu::ShaderCode& mark = pass.clusters_ ? mark_clusters : mark_splats;
  if (made) made = make(device, mark, sizeof(MarkPush), {test}, pass.mark_);
  for (std::uint32_t kind = 0; made && kind < kLightKinds; ++kind) {
    const bool shadows = settings.direct_shadows && kind == kManyLights;
    made = make(device, shadows ? shade_lists_with_shadows : shade_lists,
                shadows ? sizeof(ShadowedListShadingPush) : sizeof(ListShadingPush), {kind, clusters, divide_by_p},
                pass.shade_[kind]);
  }
  if (made) {
    made = pass.clusters_ ? place(device, proxies.icosahedron, pass.staged_proxy_, pass.proxy_)
                          : place(device, proxies.geodesic, pass.staged_proxy_, pass.proxy_);
  }
  if (!made) return made.error();
  return pass;
}

Status ListShadingPass::reserve(gpu::Device& device, std::uint32_t width, std::uint32_t height, std::uint32_t longest) {
  const std::uint64_t tiles = tile_grid(width, height, interleave_).count(), parts = tiles * parts_per_tile();
  const auto affordable = static_cast<std::uint32_t>(std::min<std::uint64_t>(kMostBytes / (4 * parts), kMostWords));
  words_ = std::max(std::min(affordable, (longest + 31) / 32), 1u);
  // Each has at least a word.
  const std::pair<gpu::Buffer*, std::uint64_t> wanted[] = {{&depths_, 2 * sizeof(word_)},
                                                           {&occupied_, tiles * sizeof(word_)},
                                                           {&cells_, clusters_ ? 4 : tiles * 16 * sizeof(SplatCell)},
                                                           {&lists_, parts * words_ * sizeof(word_)},
                                                           {&covering_, clusters_ ? 4 : tiles * kTilePixels * 2}};
  for (const auto& [buffer, bytes] : wanted) {
    if (Status grown = gpu::grow(device, *buffer, bytes, gpu::BufferUse::device); !grown) return grown;
  }
  return Done{};
}

std::uint64_t ListShadingPass::bytes() const {
  return depths_.bytes() + occupied_.bytes() + cells_.bytes() + lists_.bytes() + covering_.bytes();
}

void ListShadingPass::record_parts(gpu::CommandList& list, const gpu::Buffer& pixels,
                                   const GeometryBuffer& geometry) const {
  PartPush push{};
  push.pixels = pixels.address(), push.depths = depths_.address();
  push.occupied = occupied_.address(), push.cells = cells_.address();
  const Camera& camera = geometry.camera;
  copy(camera.eye, push.eye), copy(camera.right, push.right), copy(camera.up, push.up);
  push.width = geometry.width, push.height = geometry.height, push.interleave = interleave_;
  const TileGrid grid = tile_grid(geometry.width, geometry.height, interleave_);
  list.copy(staged_proxy_, proxy_, proxy_.bytes());
  list.fill(depths_, 0);
  list.barrier();
  list.dispatch(find_depths_, push, grid.columns, grid.rows, grid.regions);
  list.barrier();
  list.dispatch(find_parts_, push, grid.columns, grid.rows, grid.regions);
  list.barrier();
}

void ListShadingPass::record_lists(gpu::CommandList& list, const ShadingBuffers& buffers,
                                   const GeometryBuffer& geometry, std::uint32_t shift, LightPart part) const {
  MarkPush push{};
  push.bounds = buffers.lights->bounds.address(), push.subsets = buffers.subsets->address();
  push.depths = depths_.address(), push.occupied = occupied_.address(), push.cells = cells_.address();
  push.proxy = proxy_.address(), push.lists = lists_.address(), push.covering = covering_.address();
  push.counts = buffers.tile_counts->address();
  push.pixel = 2 * std::tan(0.5f * geometry.camera.vertical_fov) / static_cast<float>(geometry.height);
  push.width = geometry.width, push.height = geometry.height, push.interleave = interleave_;
  push.shift = shift, push.first_light = part.first, push.words = words_;
  const TileGrid grid = tile_grid(geometry.width, geometry.height, interleave_);
  if (part.first == 0) list.fill(*buffers.tile_counts, 0);
  list.fill(lists_, 0);
  list.fill(covering_, 0);
  list.barrier();
  const std::uint32_t rows = clusters_ ? kRowsOfClusters : kRowsOfSplats;
  list.dispatch(mark_, push, part.count, grid.regions, (grid.rows + rows - 1) / rows);
  list.barrier();
}

void ListShadingPass::record_sums(gpu::CommandList& list, LightKind kind, const ShadingBuffers& buffers,
                                  const GeometryBuffer& geometry, std::uint32_t shift, LightPart part) const {
  ListShadingPush push{};
  push.pixels = buffers.pixels->address(), push.emitters = buffers.lights->emitters.address();
  push.subsets = buffers.subsets->address(), push.sums = buffers.sums->address();
  push.depths = depths_.address(), push.lists = lists_.address(), push.covering = covering_.address();
  push.counts = buffers.tile_counts->address();
  copy(geometry.camera.eye, push.eye);
  push.width = geometry.width, push.height = geometry.height, push.interleave = interleave_;
  push.shift = shift, push.first_light = part.first, push.words = words_;
  const TileGrid grid = tile_grid(geometry.width, geometry.height, interleave_);
  if (kind == kManyLights && buffers.shadows != nullptr) {
    const ShadowedListShadingPush shadowed{push, buffers.shadows->address()};
    list.dispatch(shade_[kind], shadowed, grid.columns, grid.rows, grid.regions);
  } else {
    list.dispatch(shade_[kind], push, grid.columns, grid.rows, grid.regions);
  }
  list.barrier();
}

void ListShadingPass::record(gpu::CommandList& list, LightKind kind, const ShadingBuffers& buffers,
                             const GeometryBuffer& geometry, std::uint32_t shift, LightPart part) const {
  for (std::uint32_t done = 0; done < part.count; done += window()) {
    const LightPart now{part.first + done, std::min(window(), part.count - done)};
    record_lists(list, buffers, geometry, shift, now);
    record_sums(list, kind, buffers, geometry, shift, now);
  }
}

void add_part_counts(const PartCounts* counts, std::size_t tiles, LightCounts& to,
                     std::vector<std::uint32_t>& list_lengths) {
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const PartCounts& of = counts[tile];
    for (int part = 0; part < 32; ++part) {
      if (of.pixels[part] == 0) continue;
      list_lengths.push_back(of.listed[part]);
      to.evaluated += std::uint64_t(of.listed[part]) * of.pixels[part];
    }
    to.listed += of.pairs, to.accepted += of.accepted, to.tests += of.tests;
  }
}

}  // namespace luciole
