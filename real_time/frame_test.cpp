// SPDX-License-Identifier: Apache-2.0
// Culling changes the cost, never the picture: the same random numbers give the same bits on every path.
#include "real_time/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/parallel.h"
#include "real_time/not_finite.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

struct Stage {
  std::shared_ptr<const Scene> scene;
  Camera camera;
  PrimaryLights primaries;
};

Stage stage(const std::string& address) {
  Result<Scene> scene = make_recipe_from_address(address);
  EXPECT_TRUE(scene.has_value());
  Stage s;
  s.scene = std::make_shared<const Scene>(std::move(*scene));
  s.camera = s.scene->cameras.at(0);
  if (!s.scene->lights.empty()) s.primaries = {s.scene->lights[0]};
  return s;
}

Settings small_settings() {
  Settings settings;
  settings.width = 150, settings.height = 90;  // neither divides by a tile
  settings.vpls = 3000;                        // does not divide by 64
  settings.filter = Filter::none;
  settings.exposure = 2.0f;
  settings.delta = 0.01f;
  return settings;
}

std::vector<Vec3> picture(const Stage& stage, const Settings& settings, std::uint64_t frame_index = 0) {
  Result<Renderer> renderer = Renderer::create(stage.scene, stage.camera, stage.primaries, settings);
  EXPECT_TRUE(renderer.has_value());
  Result<Frame> frame = renderer->render(frame_index);
  EXPECT_TRUE(frame.has_value());
  return frame->picture;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

std::vector<Isa> instruction_sets() {
  std::vector<Isa> sets;
  for (Isa isa : {Isa::avx512, Isa::avx2, Isa::baseline})
    if (choose_isa(isa).has_value()) sets.push_back(isa);
  return sets;
}

TEST(LightCulling, changes_the_cost_but_never_the_picture) {
  for (const char* address : {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1", "recipe:lamps?count=500"}) {
    const Stage scene = stage(address);
    for (const std::uint32_t interleave : {1u, 8u}) {
      Settings settings = small_settings();
      settings.interleave = interleave;
      settings.culling = Culling::none;
      const std::vector<Vec3> unculled = picture(scene, settings);
      settings.culling = Culling::tiled;
      for (const BoundingVolume bounds :
           {BoundingVolume::sphere_at_light, BoundingVolume::sphere, BoundingVolume::spheroid, BoundingVolume::tight}) {
        for (const TileTest test : {TileTest::paper, TileTest::exact, TileTest::tight}) {
          settings.bounds = bounds;
          settings.tile_test = test;
          EXPECT_TRUE(same_bits(picture(scene, settings), unculled))
              << address << ", interleave " << interleave << ", bounds " << to_string(bounds) << ", tile test "
              << to_string(test);
        }
      }
    }
  }
}

// Sums and counts per pixel of one kind of lobe add up to those of both, and clamped ranges find their constant.
TEST(Lobes, left_out_are_missing_from_predictions_and_clamped_ranges_too) {
  const Stage scene = stage("recipe:cornell?glossy=0.1");
  const auto frame_of = [&](Lobes lobes, Ranges ranges) {
    Settings settings = small_settings();
    settings.lobes = lobes, settings.ranges = ranges;
    Result<Renderer> renderer = Renderer::create(scene.scene, scene.camera, scene.primaries, settings);
    return *renderer->render(0, {"predicted_accepted"});
  };
  const auto predicted = [&](Lobes lobes) {
    const Frame frame = frame_of(lobes, Ranges::stochastic);
    const std::vector<float>& accepted = frame.layers.channels.at("predicted_accepted.V");
    return std::accumulate(accepted.begin(), accepted.end(), 0.0);
  };
  const double all = predicted(Lobes::all), diffuse = predicted(Lobes::diffuse), glossy = predicted(Lobes::glossy);
  EXPECT_GT(diffuse, 0);
  EXPECT_GT(glossy, 0);
  const double rounding = 2.0 * small_settings().vpls * std::numeric_limits<float>::epsilon();  // of sums per pixel
  EXPECT_NEAR((diffuse + glossy) / all, 1.0, rounding);
  for (const Lobes lobes : {Lobes::diffuse, Lobes::glossy}) {
    const Frame frame = frame_of(lobes, Ranges::clamped);
    const PerPixel& accepted = frame.statistics.accepted;
    EXPECT_GT(accepted.total(), 0);
    EXPECT_EQ(lobes == Lobes::diffuse ? accepted.glossy : accepted.diffuse, 0);
  }
}

// The light of one kind of lobe, and no cost of the other: what [TH17] Table 2 is measured with.
TEST(Lobes, are_taken_apart_without_a_change_of_either) {
  const Stage scene = stage("recipe:cornell?glossy=0.1");
  const auto frame_of = [&](Lobes lobes) {
    Settings settings = small_settings();
    settings.lobes = lobes;
    Result<Renderer> renderer = Renderer::create(scene.scene, scene.camera, scene.primaries, settings);
    return *renderer->render(0, {"indirect_from_diffuse", "indirect_from_glossy"});
  };
  const Frame all = frame_of(Lobes::all), diffuse = frame_of(Lobes::diffuse), glossy = frame_of(Lobes::glossy);
  const auto layer = [](const Frame& frame, const char* name) { return frame.layers.colours(name); };
  EXPECT_TRUE(same_bits(layer(diffuse, "indirect_from_diffuse"), layer(all, "indirect_from_diffuse")));
  EXPECT_TRUE(same_bits(layer(glossy, "indirect_from_glossy"), layer(all, "indirect_from_glossy")));
  EXPECT_FALSE(same_bits(diffuse.picture, glossy.picture));
  EXPECT_GT(all.statistics.evaluated.glossy, 0);
  EXPECT_EQ(diffuse.statistics.evaluated.glossy, 0);
  EXPECT_EQ(glossy.statistics.evaluated.diffuse, 0);
  EXPECT_EQ(diffuse.statistics.evaluated.diffuse, all.statistics.evaluated.diffuse);
}

TEST(Rivals, of_tiled_culling_make_the_same_picture_on_any_number_of_threads) {
  for (const char* address : {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1", "recipe:lights?count=300"}) {
    const Stage scene = stage(address);
    for (const std::uint32_t interleave : {1u, 8u}) {
      Settings settings = small_settings();
      settings.interleave = interleave;
      const std::vector<Vec3> tiled = picture(scene, settings);
      for (const BoundingVolume bounds :
           {BoundingVolume::sphere_at_light, BoundingVolume::sphere, BoundingVolume::spheroid, BoundingVolume::tight}) {
        for (const Culling culling : {Culling::clustered, Culling::splatting}) {
          for (const int threads : {1, 2}) {
            settings.bounds = bounds, settings.culling = culling;
            settings.tile_test = threads == 1 ? TileTest::paper : TileTest::tight;  // with what is below the surface
            std::vector<Vec3> rival;
            with_threads(threads, [&] { rival = picture(scene, settings); });
            EXPECT_TRUE(same_bits(rival, tiled))
                << address << ", interleave " << interleave << ", bounds " << to_string(bounds) << ", "
                << to_string(culling) << ", " << threads << " threads";
          }
        }
      }
    }
  }
}

TEST(LightCulling, agrees_on_every_instruction_set) {
  const Stage scene = stage("recipe:cornell?glossy=0.1");
  for (const Isa isa : instruction_sets()) {
    Settings settings = small_settings();
    settings.isa = isa;
    const std::vector<Vec3> culled = picture(scene, settings);
    for (const Culling culling : {Culling::clustered, Culling::splatting, Culling::none}) {
      settings.culling = culling;
      EXPECT_TRUE(same_bits(picture(scene, settings), culled)) << to_string(isa) << ", " << to_string(culling);
    }
  }
}

TEST(LightCulling, with_shadow_rays_and_moving_samples_is_the_same_in_all_ways) {
  const Stage scene = stage("recipe:lamps?count=500");
  Settings settings = small_settings();
  settings.direct_shadows = settings.jitter = true;
  settings.interleave = 2, settings.vpl_seed = 3;
  const std::vector<Vec3> tiled = picture(scene, settings, 5);
  for (const Culling culling : {Culling::clustered, Culling::splatting, Culling::none}) {
    settings.culling = culling;
    EXPECT_TRUE(same_bits(picture(scene, settings, 5), tiled)) << to_string(culling);
  }
}

// Whatever finds the lights: those that are accepted are the same, and no pixel accepts one that it was not given.
TEST(LightCulling, counts_what_it_lists) {
  const Stage scene = stage("recipe:ring?alpha=0.1");
  Settings settings = small_settings();
  double accepted = 0;
  for (const Culling culling : {Culling::tiled, Culling::clustered, Culling::splatting, Culling::none}) {
    settings.culling = culling;
    Result<Renderer> renderer = Renderer::create(scene.scene, scene.camera, scene.primaries, settings);
    const Frame frame = *renderer->render(0, {"lights_listed", "lights_false", "depth"});
    const FrameStatistics& statistics = frame.statistics;
    if (culling == Culling::tiled) accepted = statistics.accepted.total();
    EXPECT_EQ(statistics.accepted.total(), accepted) << to_string(culling);
    EXPECT_GT(statistics.list_length_max, 0) << to_string(culling);
    double listed = 0, surfaces = 0;
    for (std::size_t i = 0; i < frame.picture.size(); ++i) {
      listed += frame.layers.channels.at("lights_listed.V")[i];
      surfaces += std::isfinite(frame.layers.channels.at("depth.V")[i]);
      EXPECT_GE(frame.layers.channels.at("lights_false.V")[i], 0) << to_string(culling) << ", pixel " << i;
    }
    EXPECT_NEAR(listed / surfaces, statistics.listed.total(), 1e-6 * listed / surfaces) << to_string(culling);
  }
}

// The paper's lists are those of tiles: every tile with a surface asks every light that it sees, once for both halves.
TEST(LightCulling, counts_its_tests) {
  const Stage scene = stage("recipe:cornell");
  Settings settings = small_settings();
  settings.interleave = 1, settings.tile_test = TileTest::paper;
  const auto frame_by = [&](Culling culling) {
    settings.culling = culling;
    Result<Renderer> renderer = Renderer::create(scene.scene, scene.camera, scene.primaries, settings);
    return *renderer->render(0, {"depth"});
  };
  const Frame tiled = frame_by(Culling::tiled);
  double surfaces = 0, tiles = 0;
  for (std::uint32_t top = 0; top < settings.height; top += 16) {
    for (std::uint32_t left = 0; left < settings.width; left += 16) {
      int pixels = 0;
      for (std::uint32_t y = top; y < std::min(top + 16, settings.height); ++y) {
        for (std::uint32_t x = left; x < std::min(left + 16, settings.width); ++x)
          pixels += std::isfinite(tiled.layers.channels.at("depth.V")[std::size_t(y) * settings.width + x]);
      }
      surfaces += pixels, tiles += pixels > 0;
    }
  }
  const double lights = static_cast<double>(tiled.statistics.virtual_point_lights);
  EXPECT_GT(lights, 0);
  EXPECT_NEAR(tiled.statistics.tests.diffuse * surfaces, lights * tiles, 1e-6 * lights * tiles);
  EXPECT_EQ(frame_by(Culling::none).statistics.tests.total(), 0);
  // Each light in sight costs the rivals its triangles, and then more.
  EXPECT_GT(frame_by(Culling::clustered).statistics.tests.diffuse * surfaces, 0);
  settings.tile_test = TileTest::tight;
  EXPECT_GT(frame_by(Culling::tiled).statistics.tests.diffuse, tiled.statistics.tests.diffuse);
}

TEST(LightCulling, of_another_seed_is_another_picture) {  // the comparison above can fail
  const Stage scene = stage("recipe:cornell");
  Settings settings = small_settings();
  const std::vector<Vec3> first = picture(scene, settings);
  settings.seed = 2;
  EXPECT_FALSE(same_bits(picture(scene, settings), first));
}

TEST(Frame, has_the_same_bits_on_any_number_of_threads) {
  const Stage scene = stage("recipe:lamps?count=500");
  Settings settings = small_settings();
  settings.filter = Filter::bilateral;
  std::vector<Vec3> one, three;
  with_threads(1, [&] { one = picture(scene, settings); });
  with_threads(3, [&] { three = picture(scene, settings); });
  EXPECT_TRUE(same_bits(one, three));
}

// What is kept of one view must not be seen in another: geometry, direct light, the constant of clamped ranges.
TEST(Frame, of_a_moving_camera_is_the_frame_that_this_camera_gives_alone) {
  const Stage first = stage("recipe:cornell?glossy=0.1&panel=5");
  for (const Ranges ranges : {Ranges::stochastic, Ranges::clamped}) {
    Settings settings = small_settings();
    settings.filter = Filter::bilateral, settings.ranges = ranges;
    Result<Renderer> moving = Renderer::create(first.scene, first.camera, first.primaries, settings);
    std::vector<Vec3> last;
    for (std::uint64_t frame = 0; frame < 3; ++frame) {
      Stage moved = first;
      moved.camera.eye = moved.camera.eye + moved.camera.right * (0.1f * static_cast<float>(frame));
      moving->set_camera(moved.camera);
      const std::vector<Vec3> in_sequence = moving->render(frame)->picture;
      EXPECT_TRUE(same_bits(in_sequence, picture(moved, settings, frame))) << to_string(ranges) << ", " << frame;
      EXPECT_FALSE(same_bits(in_sequence, last));
      last = in_sequence;
    }
  }
}

TEST(Frame, of_odd_sizes_and_few_lights_renders) {
  const Stage scene = stage("recipe:cornell");
  for (const auto& [width, height, vpls] :
       {std::tuple{1u, 1u, 1u}, std::tuple{17u, 3u, 2u}, std::tuple{129u, 1u, 63u}, std::tuple{5u, 200u, 65u}}) {
    Settings settings = small_settings();
    settings.width = width, settings.height = height, settings.vpls = vpls;
    const std::vector<Vec3> pixels = picture(scene, settings);
    ASSERT_EQ(pixels.size(), std::size_t(width) * height);
    for (const Vec3& pixel : pixels) EXPECT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z));
  }
}

TEST(NotFinite, light_is_counted_by_pixels_and_taken_out_of_pictures) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  constexpr float kLargest = std::numeric_limits<float>::max();
  Radiance light;
  EXPECT_EQ(count_not_finite(light), 0u);
  light.resize(200000);
  for (Plane3* planes : {&light.diffuse, &light.specular}) {
    for (Plane& plane : *planes) std::fill(plane.begin(), plane.end(), kLargest);
  }
  EXPECT_EQ(count_not_finite(light), 0u);
  light.diffuse[1][70000] = light.specular[0][70000] = nan;
  light.specular[1][199999] = -infinity;
  EXPECT_EQ(count_not_finite(light), 2u);
  std::vector<Vec3> picture = {Vec3(1, 2, 3), Vec3(nan, 1, 1), Vec3(1, 1, infinity), Vec3(kLargest, kLargest, 1)};
  EXPECT_EQ(blacken_not_finite(picture), 2u);
  EXPECT_EQ(blacken_not_finite(picture), 0u);
  EXPECT_EQ(picture[0].y, 2);
  EXPECT_EQ(picture[2].x, 0);
}

TEST(NotFinite, light_does_not_come_up_in_bundled_scenes) {
  for (const char* address : {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.05", "recipe:lamps?count=1000"}) {
    const Stage scene = stage(address);
    for (const Filter filter : {Filter::none, Filter::bilateral}) {
      Settings settings = small_settings();
      settings.filter = filter;
      Result<Renderer> renderer = Renderer::create(scene.scene, scene.camera, scene.primaries, settings);
      for (std::uint64_t frame = 0; frame < 4; ++frame) {
        EXPECT_EQ(renderer->render(frame)->statistics.pixels_not_finite, 0u) << address;
      }
    }
  }
}

// Without interleaving both counts are exact: no frame has to be averaged.
TEST(ClampedRanges, accept_as_many_lights_as_stochastic_ones) {
  const Stage scene = stage("recipe:cornell?glossy=0.1");
  Settings settings = small_settings();
  settings.interleave = 1;
  Result<Renderer> stochastic = Renderer::create(scene.scene, scene.camera, scene.primaries, settings);
  const Frame frame = *stochastic->render(0, {"predicted_accepted", "depth"});
  double expected = 0, surfaces = 0;
  for (std::size_t i = 0; i < frame.picture.size(); ++i) {
    expected += frame.layers.channels.at("predicted_accepted.V")[i];
    surfaces += std::isfinite(frame.layers.channels.at("depth.V")[i]);
  }
  const auto accepted_with = [&](Ranges ranges) {
    settings.ranges = ranges;
    Result<Renderer> renderer = Renderer::create(scene.scene, scene.camera, scene.primaries, settings);
    return renderer->render(0)->statistics.accepted.total();
  };
  EXPECT_NEAR(accepted_with(Ranges::clamped) * surfaces / expected, 1.0, 0.02);
  // Chosen by another rule: equal cost is no accident of the scene.
  EXPECT_GT(std::abs(accepted_with(Ranges::clamped_bound) * surfaces / expected - 1.0), 0.02);
}

}  // namespace
}  // namespace luciole
