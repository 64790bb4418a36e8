// SPDX-License-Identifier: Apache-2.0
// The rivals of tiled culling on the device: the CPU's lists but for what rounding decides, and the picture of all
// lights.
#include "real_time/shading/list_shading_pass.h"

#include <bit>
#include <cstdio>
#include <numeric>

#include "real_time/double_reference.h"
#include "real_time/light_culling/light_lists.h"
#include "real_time/shading/list_test_stage.h"

namespace luciole::test {
namespace {

constexpr Culling kRivals[] = {Culling::clustered, Culling::splatting};

Settings settings_of(Culling culling, std::uint32_t interleave, TileTest test = TileTest::tight) {
  Settings settings = small_settings(interleave);
  settings.culling = culling, settings.tile_test = test;
  settings.vpls = 1500;  // without interleaving more than a window has
  return settings;
}

// Without interleaving one scene is enough: lists are longer than a window, and lights of all kinds are in it.
std::vector<std::uint32_t> interleaves_of(const std::string& address) {
  if (address.starts_with("recipe:lights")) return {8, 1};
  return {8};
}

std::string what_of(const std::string& address, const Settings& s) {
  return address + ", " + to_string(s.culling) + ", interleave " + std::to_string(s.interleave) + ", test " +
         to_string(s.tile_test);
}

// body(reaching lights, their kind)
template <class Body>
void for_each_kind(const ListStage& stage, const Body& body) {
  if (stage.longest(kDiffuseLights) > 0) body(stage.reached.diffuse, kDiffuseLights);
  if (stage.longest(kGlossyLights) > 0) body(stage.reached.glossy, kGlossyLights);
  if (stage.longest(kManyLights) > 0) body(stage.reached.many, kManyLights);
}

// The ellipsoid of one lane, larger or smaller about its centre. What float may lose: as prepare_ellipsoid grows its
// axes, 4e-6 of them and of the distance to the eye, the latter in units of the shortest axis.
void resize(BoundBlock& block, int lane, float direction) {
  const auto row = [&](int r) -> float& { return block.row[r][lane]; };
  if (row(BoundBlock::kRadius) < 0) return;
  float norm_sq = 0, distance_sq = 0;
  for (int r = BoundBlock::kM00; r <= BoundBlock::kM22; ++r) norm_sq += row(r) * row(r);
  for (int r = BoundBlock::kCentreX; r <= BoundBlock::kCentreZ; ++r) distance_sq += row(r) * row(r);
  const float lost = 4e-6f * (1 + std::sqrt(norm_sq * distance_sq)), scale = 1 + direction * lost;
  if (scale <= 0.5f) {
    row(BoundBlock::kRadius) = -1;  // so thin that float may lose it
    return;
  }
  row(BoundBlock::kRadius) *= scale;
  for (int r = BoundBlock::kM00; r <= BoundBlock::kStretchedZ; ++r) row(r) /= scale;
  for (int r = BoundBlock::kSxx; r <= BoundBlock::kSzz; ++r) row(r) *= scale * scale;
  row(BoundBlock::kNormalOffset) -= direction * 4e-6f * std::sqrt(distance_sq);
}

template <class Emitter>
AlignedVector<BoundBlock> resized(const ReachingLights<Emitter>& lights, float direction) {
  AlignedVector<BoundBlock> blocks = lights.bounds;
  for (std::size_t s = 0; s < lights.begin.size(); ++s) {
    for (std::uint32_t i = lights.begin[s]; i < lights.begin[s] + lights.count[s]; ++i) {
      resize(blocks[i / 16], static_cast<int>(i % 16), direction);
    }
  }
  return blocks;
}

// Of which part of which tile each pixel is.
struct PartOfPixel {
  std::size_t tile;
  std::uint32_t part;
};

PartOfPixel part_of(const ListStage& stage, const TileParts& parts, std::size_t pixel) {
  const std::uint32_t n = stage.settings.interleave;
  const auto x = static_cast<std::uint32_t>(pixel % stage.settings.width),
             y = static_cast<std::uint32_t>(pixel / stage.settings.width);
  const std::uint32_t in_x = x / n, in_y = y / n;
  const std::size_t tile = parts.tile({n, in_x / kTileSide, in_y / kTileSide, x % n, y % n});
  const float depth = stage.front.geometry.depth[pixel];
  return {tile, stage.settings.culling == Culling::clustered ? cluster_slice_of(parts.slices(), depth)
                                                             : in_y / 4 % 4 * 4 + in_x / 4 % 4};
}

// What the CPU lists.
struct CpuLists {
  Marks marks;
  std::uint64_t pairs = 0;  // light x pixel, as LightCounts::listed
  std::uint64_t tests = 0;
};

template <class Emitter>
CpuLists cpu_lists(const ListStage& stage, const TileParts& parts, const ReachingLights<Emitter>& lights,
                   const AlignedVector<BoundBlock>& blocks) {
  const Settings& s = stage.settings;
  const std::uint32_t subsets = s.interleave * s.interleave;
  std::vector<SubsetBounds> bounds;
  for (std::uint32_t r = 0; r < subsets; ++r) {
    const std::uint32_t subset = (r + kShift) % subsets;
    bounds.push_back({blocks.data() + lights.begin[subset] / 16, lights.count[subset]});
  }
  const LightLists lists = list_lights({stage.front.geometry,
                                        parts,
                                        bounds,
                                        s.interleave,
                                        s.culling,
                                        s.tile_test,
                                        s.isa,
                                        {0, parts.columns(), 0, parts.rows()},
                                        std::size_t(1) << 24});
  CpuLists found{Marks(stage.tiles(), *std::max_element(lights.count.begin(), lights.count.end())), 0, lists.tests};
  for (std::size_t tile = 0; tile < stage.tiles(); ++tile) {
    for (std::size_t i = lists.begin[tile]; i < lists.begin[tile + 1]; ++i) {
      found.marks.of(tile, lists.light[i]) = lists.parts[i];
    }
  }
  if (s.culling == Culling::splatting) {
    for (const float covering : lists.covering) found.pairs += static_cast<std::uint64_t>(covering);
    return found;
  }
  for (std::size_t i = 0; i < stage.front.geometry.pixel_count(); ++i) {
    if (stage.front.geometry.depth[i] == kNoSurface) continue;
    const PartOfPixel at = part_of(stage, parts, i);
    for (std::uint32_t k = 0; k < found.marks.lights; ++k) found.pairs += found.marks.of(at.tile, k) >> at.part & 1u;
  }
  return found;
}

// Pairs of light and part in which a pixel accepts the light by double precision, however its float rounds.
template <class Emitter>
Marks needed(const ListStage& stage, const TileParts& parts, const ReachingLights<Emitter>& lights, LightKind kind) {
  const GeometryBuffer& g = stage.front.geometry;
  const std::uint32_t subsets = stage.settings.interleave * stage.settings.interleave;
  Marks marks(stage.tiles(), stage.longest(kind));
  for (std::size_t i = 0; i < g.pixel_count(); ++i) {
    if (g.depth[i] == kNoSurface) continue;
    const PartOfPixel at = part_of(stage, parts, i);
    const std::size_t region = at.tile / parts.tiles(), subset = (region + kShift) % subsets;
    for (std::uint32_t k = 0; k < lights.count[subset]; ++k) {
      const Emitter& light = lights.emitters[lights.begin[subset] + k];
      const f64::real3 d = wide(light.position) - wide(g.position, i);
      const double distance_sq = f64::dot(d, d), l_sq = distance_sq + light.disc;
      const f64::Emitted e = emission(light, d * (-f64::inverse_sqrt(distance_sq)));
      constexpr double kTie = 1e-5;
      if (e.peak / l_sq > light.xi * (1 + kTie) && f64::emission_is_accepted(e, l_sq, light.xi)) {
        marks.of(at.tile, k) |= 1u << at.part;
      }
    }
  }
  return marks;
}

// Bits of `a` that `b` lacks.
std::uint64_t missing(const Marks& a, const Marks& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    count += static_cast<std::uint64_t>(std::popcount(a.parts[i] & ~b.parts[i]));
  }
  return count;
}
std::uint64_t size(const Marks& marks) {
  return missing(marks, Marks(marks.parts.size() / marks.lights, marks.lights));
}

void expect_cpus_lists(const std::string& address, const Settings& settings) {
  const ListStage stage(address, settings);
  const std::string what = what_of(address, settings);
  const TileParts parts(stage.front.geometry, settings.interleave, settings.culling);
  for_each_kind(stage, [&](const auto& lights, LightKind kind) {
    const ListShadingPass pass = stage.make_pass(stage.longest(kind));
    const Marks device = stage.marks(pass, kind);
    const CpuLists cpu = cpu_lists(stage, parts, lights, lights.bounds);
    const CpuLists low = cpu_lists(stage, parts, lights, resized(lights, -1.0f));
    const CpuLists high = cpu_lists(stage, parts, lights, resized(lights, 1.0f));
    EXPECT_GT(size(cpu.marks), 0u) << what;
    EXPECT_EQ(missing(low.marks, device), 0u) << what << ", kind " << kind;
    EXPECT_EQ(missing(device, high.marks), 0u) << what << ", kind " << kind;
    EXPECT_EQ(missing(needed(stage, parts, lights, kind), device), 0u) << what << ", kind " << kind;
    std::printf("%s, kind %d: %llu listed, %llu only by the CPU, %llu only by the device; rounding may decide %llu\n",
                what.c_str(), kind, static_cast<unsigned long long>(size(cpu.marks)),
                static_cast<unsigned long long>(missing(cpu.marks, device)),
                static_cast<unsigned long long>(missing(device, cpu.marks)),
                static_cast<unsigned long long>(missing(high.marks, low.marks)));
  });
}

TEST(ListsOnTheDevice, are_the_cpus_but_for_what_rounding_decides_and_lose_no_accepted_light) {
  for (const char* address : kScenes) {
    for (const std::uint32_t interleave : interleaves_of(address)) {
      for (const Culling culling : kRivals) expect_cpus_lists(address, settings_of(culling, interleave));
    }
  }
}

TEST(ListsOnTheDevice, are_the_cpus_with_the_other_tile_tests) {
  for (const TileTest test : {TileTest::paper, TileTest::exact}) {
    for (const Culling culling : kRivals) expect_cpus_lists("recipe:ring?alpha=0.1", settings_of(culling, 8, test));
    expect_cpus_lists("recipe:cornell?glossy=0.1", settings_of(Culling::clustered, 1, test));
  }
}

// Workgroups take up to 32 or 4 rows of tiles, and of clusters 16x16 tiles at a time.
TEST(ListsOnTheDevice, of_lights_larger_than_what_a_workgroup_takes_at_once_are_the_cpus) {
  for (const Culling culling : kRivals) {
    Settings settings = settings_of(culling, 1);
    settings.width = 290, settings.height = 530, settings.vpls = 48;
    expect_cpus_lists("recipe:cornell?glossy=0.1", settings);
    const ListStage stage("recipe:cornell?glossy=0.1", settings);
    Marks marks = stage.marks(stage.make_pass(stage.longest(kDiffuseLights)), kDiffuseLights);
    const TileGrid grid = tile_grid(settings.width, settings.height, 1);
    std::uint32_t all_over = 0;
    for (std::uint32_t light = 0; light < marks.lights; ++light) {
      const auto in = [&](std::uint32_t row, std::uint32_t end) {
        std::uint32_t parts = 0;
        for (std::uint32_t t = row * grid.columns + 16; t < end * grid.columns; t += grid.columns) {
          parts |= marks.of(t, light);
        }
        return parts != 0;
      };
      all_over += in(0, 4) && in(30, 32) && in(32, grid.rows);
    }
    EXPECT_GT(all_over, 0u) << to_string(culling);
  }
}

SphereProxies proxies_of_size(float scale) {
  SphereProxies proxies;
  const auto resize_all = [scale](auto& values) {
    for (auto& axis : values)
      for (float& value : axis) value *= scale;
  };
  resize_all(proxies.icosahedron.vertex);
  resize_all(proxies.icosahedron.edge_from), resize_all(proxies.icosahedron.edge_to);
  proxies.icosahedron.distance *= scale;
  for (auto& corner : proxies.geodesic.corner) resize_all(corner);
  for (float& distance : proxies.geodesic.distance) distance *= scale;
  return proxies;
}

TEST(ListsOnTheDevice, of_a_proxy_a_tenth_too_small_or_a_slice_too_few_are_caught) {
  for (const Culling culling : kRivals) {
    const ListStage stage("recipe:ring?alpha=0.1", settings_of(culling, 8));
    const TileParts parts(stage.front.geometry, stage.settings.interleave, culling);
    const auto& lights = stage.reached.glossy;
    const std::uint32_t longest = stage.longest(kGlossyLights);
    const CpuLists low = cpu_lists(stage, parts, lights, resized(lights, -1.0f));
    const Marks wanted = needed(stage, parts, lights, kGlossyLights);
    const ListShadingPass small = stage.make_pass(longest, proxies_of_size(0.9f));
    const Marks of_small = stage.marks(small, kGlossyLights);
    EXPECT_GT(missing(low.marks, of_small), 0u) << to_string(culling);
    EXPECT_GT(missing(wanted, of_small), 0u) << to_string(culling);
    const Shaded all = stage.shade_tiles(kGlossyLights, Culling::none);
    EXPECT_GT(other_sums(stage.front.geometry, stage.shade_lists(small, kGlossyLights), all), 0u) << to_string(culling);
    Marks shorter = stage.marks(stage.make_pass(longest), kGlossyLights);
    for (std::uint32_t& bits : shorter.parts) bits &= ~std::bit_floor(bits);
    EXPECT_GT(missing(low.marks, shorter), 0u) << to_string(culling);
    EXPECT_GT(missing(wanted, shorter), 0u) << to_string(culling);
  }
}

// mark_splats.comp asks with this reach which rows of tiles a light may be in.
TEST(SphereProxies, reach_no_farther_than_the_kernels_look) {
  const GeodesicProxy& proxy = circumscribed_geodesic();
  for (const auto& corner : proxy.corner) {
    for (int i = 0; i < GeodesicProxy::kTriangles; ++i) {
      EXPECT_LT(std::hypot(corner[0][i], corner[1][i], corner[2][i]), 1.25f);
    }
  }
}

// That of all lights is compared with double precision by tile_shading_pass_test.cpp.
TEST(ListShadingOnTheDevice, adds_what_all_lights_add_bit_for_bit) {
  for (const char* address : kScenes) {
    for (const std::uint32_t interleave : interleaves_of(address)) {
      for (const Culling culling : kRivals) {
        const Settings settings = settings_of(culling, interleave, interleave == 8 ? TileTest::tight : TileTest::paper);
        const ListStage stage(address, settings);
        for_each_kind(stage, [&](const auto&, LightKind kind) {
          const Shaded lists = stage.shade_lists(stage.make_pass(stage.longest(kind)), kind);
          EXPECT_EQ(other_sums(stage.front.geometry, lists, stage.shade_tiles(kind, Culling::none)), 0u)
              << what_of(address, settings) << ", kind " << kind;
        });
      }
    }
  }
}

TEST(ListShadingOnTheDevice, is_the_same_in_windows_of_any_length) {
  for (const Culling culling : kRivals) {
    const ListStage stage("recipe:cornell?glossy=0.1", settings_of(culling, 1));
    const ListShadingPass whole = stage.make_pass(stage.longest(kDiffuseLights)), windows = stage.make_pass(64);
    ASSERT_GT(stage.longest(kDiffuseLights), whole.window());
    ASSERT_LT(windows.window(), whole.window());
    const Shaded a = stage.shade_lists(whole, kDiffuseLights), b = stage.shade_lists(windows, kDiffuseLights);
    EXPECT_EQ(other_sums(stage.front.geometry, a, b), 0u) << to_string(culling);
    for (std::size_t t = 0; t < stage.tiles(); ++t) {
      EXPECT_EQ(std::memcmp(&a.parts[t], &b.parts[t], sizeof(PartCounts)), 0) << to_string(culling) << ", tile " << t;
    }
  }
}

// The statistics of the CPU, as far as lists are the same. `evaluated` is not: the CPU counts the lanes of groups.
void expect_cpus_counts(const std::string& address, const Settings& settings) {
  const ListStage stage(address, settings);
  const std::string what = what_of(address, settings);
  const TileParts parts(stage.front.geometry, settings.interleave, settings.culling);
  const bool clusters = settings.culling == Culling::clustered;
  for_each_kind(stage, [&](const auto& lights, LightKind kind) {
    const ListShadingPass pass = stage.make_pass(stage.longest(kind));
    const Shaded shaded = stage.shade_lists(pass, kind);
    LightCounts counts;
    std::vector<std::uint32_t> lengths;
    add_part_counts(shaded.parts.data(), stage.tiles(), counts, lengths);
    EXPECT_EQ(lengths.size(), parts.count()) << what;
    EXPECT_EQ(std::accumulate(lengths.begin(), lengths.end(), std::uint64_t{0}), size(stage.marks(pass, kind))) << what;
    const CpuLists cpu = cpu_lists(stage, parts, lights, lights.bounds);
    const CpuLists low = cpu_lists(stage, parts, lights, resized(lights, -1.0f));
    const CpuLists high = cpu_lists(stage, parts, lights, resized(lights, 1.0f));
    std::printf("%s, kind %d: pairs %llu of %llu, tests %llu of %llu\n", what.c_str(), kind,
                static_cast<unsigned long long>(counts.listed), static_cast<unsigned long long>(cpu.pairs),
                static_cast<unsigned long long>(counts.tests), static_cast<unsigned long long>(cpu.tests));
    EXPECT_GE(counts.listed, low.pairs) << what;
    EXPECT_LE(counts.listed, high.pairs) << what;
    EXPECT_GE(counts.tests, low.tests) << what;
    EXPECT_LE(counts.tests, high.tests) << what;
    if (clusters) {
      EXPECT_EQ(counts.evaluated, counts.listed) << what;
    }
    std::uint64_t listed = 0, accepted = 0;
    for (std::size_t i = 0; i < shaded.sums.size(); ++i) {
      if (stage.front.geometry.depth[i] == kNoSurface) continue;
      listed += shaded.sums[i].listed, accepted += shaded.sums[i].accepted;
    }
    EXPECT_EQ(counts.listed, listed) << what;
    EXPECT_EQ(counts.accepted, accepted) << what;
    EXPECT_GT(counts.accepted, 0u) << what;
  });
}

TEST(ListShadingOnTheDevice, counts_what_the_cpu_counts) {
  for (const Culling culling : kRivals) {
    expect_cpus_counts("recipe:ring?alpha=0.1", settings_of(culling, 8));
    expect_cpus_counts("recipe:cornell?glossy=0.1", settings_of(culling, 1));
  }
}

}  // namespace
}  // namespace luciole::test
