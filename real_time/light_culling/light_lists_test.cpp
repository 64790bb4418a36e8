// SPDX-License-Identifier: Apache-2.0
// Clusters of whole frames beside an exact test of ellipsoid against cluster: nothing is missing, and little is added.
#include "real_time/light_culling/light_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "equations/cpp/float.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "real_time/light_range/light_range.h"
#include "real_time/shading/shading_pass.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

struct Stage {
  Settings settings;
  GeometryBuffer geometry;
  ReachingLights<GlossyEmitter> glossy;
  ReachingLights<DiffuseEmitter> diffuse;
};

Stage stage(const std::string& address, std::uint32_t interleave) {
  auto scene = std::make_shared<const Scene>(std::move(*make_recipe_from_address(address)));
  Stage s;
  s.settings.width = 150, s.settings.height = 90, s.settings.vpls = 1500, s.settings.interleave = interleave;
  s.settings.exposure = 2.0f, s.settings.delta = 0.01f, s.settings.culling = Culling::clustered;
  s.settings.isa = *choose_isa(Isa::automatic);
  const RayScene rays = std::move(*RayScene::create(scene));
  render_geometry_buffer({rays, scene->cameras.at(0), s.settings.width, s.settings.height}, s.geometry);
  const VirtualPointLights lights = make_virtual_point_lights(rays, {scene->lights.at(0)}, s.settings, 0);
  const RangeParameters range = range_parameters(s.settings, s.geometry.camera, {1, 0}, -1.0f);
  s.glossy = reach_glossy_lobes(lights, range, interleave, s.settings.isa);
  s.diffuse = reach_diffuse_lobes(lights, range, interleave, s.settings.isa);
  return s;
}

f32::TileTestEllipsoid ellipsoid_of(const BoundBlock& block, std::uint32_t lane) {
  const auto rows = [&](int r) {
    return f32::real3(block.row[r][lane], block.row[r + 1][lane], block.row[r + 2][lane]);
  };
  const f32::real3 m0 = rows(BoundBlock::kM00), m1 = rows(BoundBlock::kM11);
  f32::TileTestEllipsoid t{};
  t.factor = {m0.x, m0.y, m0.z, m1.x, m1.y, m1.z};
  t.stretched = rows(BoundBlock::kStretchedX), t.centre = rows(BoundBlock::kCentreX);
  t.surface = {rows(BoundBlock::kNormalX), block.row[BoundBlock::kNormalOffset][lane]};
  return t;
}

// The slopes between which the pixels of a tile lie, edge to edge.
f32::Tile tile_slopes(const GeometryBuffer& geometry, const TileAddress& at) {
  const float pixel = 2 * std::tan(0.5f * geometry.camera.vertical_fov) / static_cast<float>(geometry.height);
  const auto edge = [&](std::uint32_t block, std::uint32_t offset, std::uint32_t size) {
    const float n = static_cast<float>(at.interleave);
    const float screen = (16 * static_cast<float>(block) - 0.5f) * n + static_cast<float>(offset) + 0.5f;
    return (screen - 0.5f * static_cast<float>(size)) * pixel;
  };
  f32::Tile tile{};
  tile.x_low = edge(at.bx, at.sx, geometry.width), tile.x_high = edge(at.bx + 1, at.sx, geometry.width);
  tile.y_low = -edge(at.by + 1, at.sy, geometry.height), tile.y_high = -edge(at.by, at.sy, geometry.height);
  tile.far_low = 1, tile.far_high = 0;
  return tile;
}

struct Candidates {
  double listed = 0, exact = 0, missing = 0;  // light x cluster pairs
};

template <class Emitter>
Candidates candidates(const Stage& s, const ReachingLights<Emitter>& lights, TileTest test) {
  const std::uint32_t n = s.settings.interleave;
  const TileParts parts(s.geometry, n, Culling::clustered);
  std::vector<SubsetBounds> bounds;
  for (std::uint32_t r = 0; r < n * n; ++r)
    bounds.push_back({lights.bounds.data() + lights.begin[r] / 16, lights.count[r]});
  const LightLists lists = list_lights({s.geometry,
                                        parts,
                                        bounds,
                                        n,
                                        Culling::clustered,
                                        test,
                                        s.settings.isa,
                                        {0, parts.columns(), 0, parts.rows()},
                                        std::size_t(1) << 24});
  Candidates pairs;
  for (std::uint32_t tile = 0; tile < parts.occupied().size(); ++tile) {
    const std::uint32_t r = tile / (parts.columns() * parts.rows()),
                        in_region = tile % (parts.columns() * parts.rows());
    f32::Tile cluster =
        tile_slopes(s.geometry, {n, in_region % parts.columns(), in_region / parts.columns(), r % n, r / n});
    for (std::uint32_t left = parts.occupied()[tile]; left != 0; left &= left - 1) {
      const auto slice = static_cast<std::uint32_t>(std::countr_zero(left));
      cluster.near_low = depth_of_slice(parts.slices(), slice);
      cluster.near_high = depth_of_slice(parts.slices(), slice + 1);
      std::size_t next = lists.begin[tile];
      for (std::uint32_t light = 0; light < lights.count[r]; ++light) {
        const bool in_tile = next < lists.begin[tile + 1] && lists.light[next] == light;
        const bool listed = in_tile && (lists.parts[next] >> slice & 1u) != 0;
        const BoundBlock& block = bounds[r].blocks[light / 16];
        const bool reaches = block.row[BoundBlock::kRadius][light % 16] >= 0;
        const bool exact =
            reaches && f32::ellipsoid_touches_tile_exactly(ellipsoid_of(block, light % 16), cluster).near_half;
        next += in_tile;
        pairs.listed += listed, pairs.exact += exact, pairs.missing += exact && !listed;
      }
      EXPECT_EQ(next, lists.begin[tile + 1]);  // the list is ascending
    }
  }
  return pairs;
}

TEST(Clusters, of_frames_list_less_than_a_fifth_more_than_an_exact_test) {
  double largest = 0;
  for (const char* address : {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1"}) {
    for (const std::uint32_t interleave : {1u, 8u}) {
      const Stage s = stage(address, interleave);
      for (const Candidates& c :
           {candidates(s, s.diffuse, TileTest::tight), candidates(s, s.glossy, TileTest::tight)}) {
        EXPECT_EQ(c.missing, 0) << address << ", interleave " << interleave;
        EXPECT_GT(c.exact, 100);
        EXPECT_LT(c.listed / c.exact, 1.2) << address << ", interleave " << interleave;
        largest = std::max(largest, c.listed / c.exact);
      }
    }
  }
  RecordProperty("listed_over_exact", std::to_string(largest));
}

TEST(Clusters, of_the_exact_test_are_just_those) {
  const Stage s = stage("recipe:ring?alpha=0.1", 1);
  const Candidates exact = candidates(s, s.glossy, TileTest::exact);
  EXPECT_EQ(exact.missing, 0);
  EXPECT_LT(exact.listed / exact.exact, 1.06);  // clusters overlap a little
  const Candidates paper = candidates(s, s.glossy, TileTest::paper);
  EXPECT_EQ(paper.missing, 0);
  EXPECT_GT(paper.listed / paper.exact, 1.2);  // proxies alone list more: light behind the light's surface as well
}

// Frames whose lists would be too long are listed window by window.
TEST(Rivals, that_list_one_window_after_the_other_make_the_same_picture) {
  for (const std::uint32_t interleave : {1u, 2u}) {
    Stage s = stage("recipe:ring?alpha=0.1", interleave);
    for (const Culling culling : {Culling::clustered, Culling::splatting}) {
      s.settings.culling = culling;
      const ReachingLights<ManyEmitter> none;
      ShadingInputs inputs{s.geometry, s.diffuse, s.glossy, none, s.settings};
      const ShadingOutputs whole = shade(inputs);
      inputs.most_entries = 100;
      const ShadingOutputs windows = shade(inputs);
      EXPECT_EQ(windows.diffuse.accepted, whole.diffuse.accepted);
      EXPECT_EQ(windows.glossy.accepted, whole.glossy.accepted);
      EXPECT_GT(whole.glossy.accepted, 0u);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(windows.radiance.indirect.diffuse[c], whole.radiance.indirect.diffuse[c]);
        EXPECT_EQ(windows.radiance.indirect.specular[c], whole.radiance.indirect.specular[c]);
      }
    }
  }
}

TEST(Lists, that_grow_too_long_are_given_up_unless_they_are_one_blocks) {
  const Stage s = stage("recipe:ring?alpha=0.1", 2);
  const TileParts parts(s.geometry, 2, Culling::clustered);
  std::vector<SubsetBounds> bounds;
  for (std::uint32_t r = 0; r < 4; ++r)
    bounds.push_back({s.diffuse.bounds.data() + s.diffuse.begin[r] / 16, s.diffuse.count[r]});
  const auto lists = [&](TileWindow window, std::size_t most) {
    return list_lights(
        {s.geometry, parts, bounds, 2, Culling::clustered, TileTest::tight, s.settings.isa, window, most});
  };
  const TileWindow all{0, parts.columns(), 0, parts.rows()}, one{2, 3, 1, 2};
  const LightLists whole = lists(all, std::size_t(1) << 24);
  EXPECT_TRUE(whole.complete);
  EXPECT_FALSE(lists(all, whole.light.size() - 1).complete);
  EXPECT_TRUE(lists(all, whole.light.size()).complete);
  const LightLists block = lists(one, 1);
  EXPECT_TRUE(block.complete);
  EXPECT_GT(block.light.size(), 1u);
}

}  // namespace
}  // namespace luciole
