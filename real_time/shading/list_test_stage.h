// SPDX-License-Identifier: Apache-2.0
// For tests of the rivals on a device: a scene's pixels and lights there, as the CPU made them, and what the passes
// make of them. Both engines read the same bounds, so that lists may differ by the rounding of the proxies alone.
#pragma once
#include "gpu/test_device.h"
#include "real_time/shading/list_shading_pass.h"
#include "real_time/vulkan_test_front.h"
#include "real_time/vulkan_transfer.h"

namespace luciole::test {

// Which lights are in which parts: word (tile * lights + light) has a bit per part of the tile.
struct Marks {
  std::uint32_t lights = 0;  // the longest subset
  std::vector<std::uint32_t> parts;

  Marks(std::size_t tiles, std::uint32_t longest) : lights(longest), parts(tiles * longest, 0u) {}
  std::uint32_t& of(std::size_t tile, std::uint32_t light) { return parts[tile * lights + light]; }
};

// What a pass made of the lights of one kind.
struct Shaded {
  std::vector<PixelSums> sums;    // per pixel; only of surfaces
  std::vector<PartCounts> parts;  // of the rivals
};

class ListStage {
 public:
  ListStage(const std::string& address, const Settings& wanted, const gpu::DeviceRequest& request = {})
      : settings(wanted),
        front(address, settings),
        reached(reach(front, settings, range_of(front, settings))),
        device(gpu::test::open_device(request)) {
    pixels_ = place<PixelRecord>(front.geometry.pixel_count(), [&](PixelRecord* to) { pack(front.geometry, to); });
    place_lights(reached.diffuse, kDiffuseLights), place_lights(reached.glossy, kGlossyLights);
    place_lights(reached.many, kManyLights);
    const TileGrid grid = tile_grid(settings.width, settings.height, settings.interleave);
    sums_ = gpu::test::make_buffer(*device, front.geometry.pixel_count() * sizeof(PixelSums), gpu::BufferUse::device);
    counts_ = gpu::test::make_buffer(*device, grid.count() * sizeof(PartCounts), gpu::BufferUse::device);
  }

  std::size_t tiles() const { return tile_grid(settings.width, settings.height, settings.interleave).count(); }
  std::uint32_t longest(LightKind kind) const { return longest_[kind]; }  // subset of a kind; 0: no lights

  ListShadingPass make_pass(std::uint32_t longest, const SphereProxies& proxies = {}) const {
    Result<ListShadingPass> pass = ListShadingPass::create(*device, settings, proxies);
    EXPECT_TRUE(pass.has_value()) << pass.error().message;
    EXPECT_TRUE(pass->reserve(*device, settings.width, settings.height, longest).has_value());
    return std::move(*pass);
  }

  // All lights of a kind, by lists.
  Shaded shade_lists(const ListShadingPass& pass, LightKind kind) const {
    gpu::CommandList list = gpu::test::make_list(*device);
    list.begin_pass("lists");
    pass.record_parts(list, pixels_, front.geometry);
    pass.record(list, kind, buffers(kind), front.geometry, kShift, {0, longest_[kind]});
    Shaded shaded;
    const gpu::Buffer sums = received(list, sums_), counts = received(list, counts_);
    EXPECT_TRUE(list.run().has_value());
    shaded.sums = gpu::test::values_in<PixelSums>(sums, front.geometry.pixel_count());
    shaded.parts = gpu::test::values_in<PartCounts>(counts, tiles());
    return shaded;
  }

  // The same by the pass of tiled culling, or without culling.
  Shaded shade_tiles(LightKind kind, Culling culling, LightReads reads = LightReads::by_pixel) const {
    Settings other = settings;
    other.culling = culling;
    const Result<TileShadingPass> pass = TileShadingPass::create(*device, other, reads);
    EXPECT_TRUE(pass.has_value());
    gpu::CommandList list = gpu::test::make_list(*device);
    list.begin_pass("tiles");
    pass->record(list, kind, buffers(kind), front.geometry, kShift, {0, longest_[kind]});
    Shaded shaded;
    const gpu::Buffer sums = received(list, sums_);
    EXPECT_TRUE(list.run().has_value());
    shaded.sums = gpu::test::values_in<PixelSums>(sums, front.geometry.pixel_count());
    return shaded;
  }

  // The lists of a kind, window by window.
  Marks marks(const ListShadingPass& pass, LightKind kind) const {
    Marks all(tiles(), longest_[kind]);
    for (std::uint32_t first = 0; first < longest_[kind]; first += pass.window()) {
      const std::uint32_t count = std::min(pass.window(), longest_[kind] - first);
      gpu::CommandList list = gpu::test::make_list(*device);
      list.begin_pass("lists");
      pass.record_parts(list, pixels_, front.geometry);
      pass.record_lists(list, buffers(kind), front.geometry, kShift, {first, count});
      const gpu::Buffer words = received(list, pass.lists());
      EXPECT_TRUE(list.run().has_value());
      for (std::size_t part = 0; part < tiles() * pass.parts_per_tile(); ++part) {
        for (std::uint32_t i = 0; i < count; ++i) {
          const std::uint32_t bit = words.as<word_>()[part * pass.words() + i / 32] >> i % 32 & 1u;
          all.of(part / pass.parts_per_tile(), first + i) |= bit << part % pass.parts_per_tile();
        }
      }
    }
    return all;
  }

  Settings settings;
  Front front;
  Reached reached;
  std::unique_ptr<gpu::Device> device;

 private:
  template <class Record, class Write>
  gpu::Buffer place(std::size_t count, const Write& write) const {
    const std::uint64_t bytes = count * sizeof(Record);
    const gpu::Buffer staged = gpu::test::make_buffer(*device, bytes, gpu::BufferUse::upload);
    write(staged.as<Record>());
    gpu::Buffer placed = gpu::test::make_buffer(*device, bytes, gpu::BufferUse::device);
    gpu::CommandList list = gpu::test::make_list(*device);
    list.begin_pass("transfer");
    list.copy(staged, placed, bytes);
    EXPECT_TRUE(list.run().has_value());
    return placed;
  }

  template <class Emitter>
  void place_lights(const ReachingLights<Emitter>& lights, LightKind kind) {
    const auto copy_to = [](const auto& values) {
      return [&values](auto* to) { std::copy(values.begin(), values.end(), to); };
    };
    LightsOnDevice& on = lights_[kind];
    on.entries = static_cast<std::uint32_t>(lights.emitters.size());
    if (on.entries == 0) return;
    on.emitters = place<Emitter>(lights.emitters.size(), copy_to(lights.emitters));
    on.bounds = place<BoundBlock>(lights.bounds.size(), copy_to(lights.bounds));
    subsets_[kind] = place<SubsetRange>(lights.begin.size(), [&](SubsetRange* to) {
      for (std::size_t s = 0; s < lights.begin.size(); ++s) to[s] = {lights.begin[s], lights.count[s]};
    });
    longest_[kind] = *std::max_element(lights.count.begin(), lights.count.end());
  }

  gpu::Buffer received(gpu::CommandList& list, const gpu::Buffer& from) const {
    gpu::Buffer to = gpu::test::make_buffer(*device, from.bytes(), gpu::BufferUse::readback);
    list.barrier();
    list.copy(from, to, from.bytes());
    return to;
  }

  ShadingBuffers buffers(LightKind kind) const { return {&pixels_, &subsets_[kind], &lights_[kind], &sums_, &counts_}; }

  gpu::Buffer pixels_, sums_, counts_;
  std::array<gpu::Buffer, kLightKinds> subsets_;
  std::array<LightsOnDevice, kLightKinds> lights_;
  std::array<std::uint32_t, kLightKinds> longest_{};
};

inline bool same_sums(const PixelSums& a, const PixelSums& b) {
  return std::memcmp(a.diffuse, b.diffuse, 12) == 0 && std::memcmp(a.specular, b.specular, 12) == 0 &&
         a.accepted == b.accepted;
}

// Pixels with a surface whose sums differ in a bit.
inline std::size_t other_sums(const GeometryBuffer& geometry, const Shaded& a, const Shaded& b) {
  std::size_t others = 0;
  for (std::size_t i = 0; i < geometry.pixel_count(); ++i) {
    others += geometry.depth[i] != kNoSurface && !same_sums(a.sums[i], b.sums[i]);
  }
  return others;
}

}  // namespace luciole::test
