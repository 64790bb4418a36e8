// SPDX-License-Identifier: Apache-2.0
// The mean over random ranges is the sum over all lights: the image z-test, on bundled scenes, and what it must reject.
#include <gtest/gtest.h>

#include <cstdlib>

#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "real_time/light_range/light_range.h"
#include "real_time/settings_text.h"
#include "real_time/shading/shading_pass.h"
#include "real_time/virtual_point_lights/place_lights.h"
#include "shot/find_shot.h"
#include "shot/open_shot.h"
#include "tests/unbiased_fixture.h"

namespace luciole::test {
namespace {

// The glossy lobes' light as a program would have it that accepts them by p and forgets to divide by it.
class GlossyLight {
 public:
  GlossyLight(const Stage& stage, const Settings& settings)
      : settings_(settings), rays_(std::move(*RayScene::create(stage.scene))) {
    settings_.isa = *choose_isa(Isa::automatic);
    render_geometry_buffer({rays_, stage.camera, settings.width, settings.height}, geometry_);
    std::vector<SurfaceTexel> texels;
    ReflectiveShadowMaps(stage.primaries, rays_.bounds(), settings.vpls).render(rays_, {}, texels);
    place_virtual_point_lights(texels, lights_);
  }

  std::vector<Vec3> without_p(std::uint64_t frame_index) const {
    const FrameKey key{settings_.seed, frame_index};
    const RangeParameters range = range_parameters(settings_, geometry_.camera, key, -1.0f);
    const auto diffuse = reach_diffuse_lobes(lights_, range, settings_.interleave, settings_.isa);
    const auto glossy = reach_glossy_lobes(lights_, range, settings_.interleave, settings_.isa);
    const ReachingLights<ManyEmitter> none;
    Settings unweighted = settings_;
    unweighted.ranges = Ranges::clamped;  // weight 1, on lights that have random ranges
    ShadingInputs inputs{geometry_, diffuse, glossy, none, unweighted, subset_shift(key, settings_.interleave)};
    inputs.lobes_apart = true;
    const ShadingOutputs out = shade(inputs);
    const Radiance& light = out.radiance.from_glossy;
    std::vector<Vec3> pixels(geometry_.pixel_count());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto at = [i](const Plane3& p) { return Vec3(p[0][i], p[1][i], p[2][i]); };
      if (geometry_.depth[i] != kNoSurface)
        pixels[i] = at(light.diffuse) * at(geometry_.diffuse_albedo) + at(light.specular);
    }
    return pixels;
  }

 private:
  Settings settings_;
  RayScene rays_;
  GeometryBuffer geometry_;
  VirtualPointLights lights_;
};

class Unbiased : public testing::TestWithParam<std::tuple<const char*, std::uint32_t, NearField>> {};

TEST_P(Unbiased, mean_over_random_ranges_is_the_sum_over_all_lights) {
  const auto& [address, interleave, near_field] = GetParam();
  Settings settings = test_settings(interleave);
  settings.near_field = near_field;
  const ZTestReport report = test_frames(stage(address), settings, settings);
  EXPECT_TRUE(report.passed) << address << ": " << report.reason;
}

// 5,000 punctual lights, not 500: one light that outshines its 1/64 of them is seen by 4 of 256 frames, and the mean of
// 4 events is not normal, however right it is.
INSTANTIATE_TEST_SUITE_P(Scenes, Unbiased,
                         testing::Combine(testing::Values("recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1",
                                                          "recipe:lights?count=5000", "recipe:gallery?detail=0.05"),
                                          testing::Values(1u, 8u), testing::Values(NearField::disc, NearField::point)));

// A real scene, with textures, normal maps and masked leaves.
TEST(Unbiased, holds_in_sponza) {
  SearchFolders folders;
  folders.shots = {LUCIOLE_SOURCE_DIR "/shots"};
  if (const char* scenes = std::getenv("LUCIOLE_SCENES")) {
    folders.scenes = {scenes};
  } else {
    GTEST_SKIP() << "LUCIOLE_SCENES is not set: Sponza is not bundled";
  }
  const Result<Shot> shot = find_shot("sponza", folders);
  ASSERT_TRUE(shot.has_value()) << shot.error().message;
  Result<OpenedShot> opened = open_shot(*shot, folders);
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  const Stage sponza{std::make_shared<const Scene>(std::move(opened->scene)), opened->camera, opened->primary};
  for (const std::uint32_t interleave : {1u, 8u}) {
    Settings settings = test_settings(interleave);
    const Result<Settings> listed = settings_from(shot->settings, {});
    ASSERT_TRUE(listed.has_value()) << listed.error().message;
    settings.exposure = listed->exposure;
    const ZTestReport report = test_frames(sponza, settings, settings);
    EXPECT_TRUE(report.passed) << "interleave " << interleave << ": " << report.reason;
  }
}

// Emissive triangles move their point every frame, so each frame has a reference of its own.
TEST(Unbiased, holds_for_emissive_triangles_around_each_frames_points) {
  const Stage scene = stage("recipe:lamps?count=1000");
  for (const std::uint32_t interleave : {1u, 8u}) {
    const Settings settings = test_settings(interleave);
    EstimatorStatistics statistics = expectation_of(scene, settings);
    Renderer renderer = renderer_of(scene, settings);
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const Result<Frame> frame = renderer.render(i, {"unfiltered", "reference"});
      std::vector<Vec3> light = frame->layers.colours("unfiltered");
      const std::vector<Vec3> own = frame->layers.colours("reference");
      for (std::size_t p = 0; p < light.size(); ++p) light[p] += statistics.expectation().mean[p] - own[p];
      statistics.add(light);
    }
    ZTestLimits limits;  // the prediction is that of the first frame's points: the variance follows it loosely
    limits.lowest_variance_ratio = 0.5, limits.highest_variance_ratio = 2;
    const ZTestReport report = image_z_test(statistics, limits);
    EXPECT_TRUE(report.passed) << report.reason;
  }
}

TEST(Unbiased, holds_for_ranges_stratified_over_the_lights) {
  Settings settings = test_settings(8);
  EstimatorStatistics statistics = expectation_of(stage("recipe:cornell?glossy=0.1"), settings);
  settings.stratified_ranges = true;
  Renderer renderer = renderer_of(stage("recipe:cornell?glossy=0.1"), settings);
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    statistics.add(renderer.render(i, {"unfiltered"})->layers.colours("unfiltered"));
  }
  // Strata make the estimate scatter less than the prediction for independent numbers: only its mean is tested.
  ZTestLimits limits;
  limits.lowest_variance_ratio = 0;
  const ZTestReport report = image_z_test(statistics, limits);
  EXPECT_TRUE(report.passed) << report.reason;
}

// The likely mistakes, at the same size: all must be rejected.

TEST(Unbiased, clamped_ranges_are_rejected) {
  const Settings settings = test_settings(8);
  Settings clamped = settings;
  clamped.ranges = Ranges::clamped;
  EXPECT_FALSE(test_frames(stage("recipe:cornell?glossy=0.1"), settings, clamped).passed);
}

TEST(Unbiased, a_weight_of_63_for_64_is_rejected) {
  constexpr std::uint32_t kMoreFrames = 8 * kFrames;  // 1.6 % is little: at 256 frames it is 2 to 4 standard deviations
  const Settings settings = test_settings(8);
  const auto spoil = [](std::vector<Vec3>& light, const Image&) {
    for (Vec3& pixel : light) pixel = pixel * (63.0f / 64.0f);
  };
  EXPECT_FALSE(test_frames(stage("recipe:cornell?glossy=0.1"), settings, settings, spoil, kMoreFrames).passed);
}

TEST(Unbiased, ranges_five_percent_short_are_rejected) {
  // p of a range 5 % shorter is .95^2 p: delta / .95^2 accepts that often, and 1/p is the longer range's.
  const Settings settings = test_settings(8);
  Settings shorter = settings;
  shorter.delta = settings.delta / (0.95f * 0.95f);
  const auto spoil = [](std::vector<Vec3>& light, const Image&) {
    for (Vec3& pixel : light) pixel = pixel * (0.95f * 0.95f);
  };
  EXPECT_FALSE(test_frames(stage("recipe:cornell?glossy=0.1"), settings, shorter, spoil).passed);
}

TEST(Unbiased, one_lobe_without_its_probability_is_rejected) {
  const Settings settings = test_settings(8);
  const Stage scene = stage("recipe:cornell?glossy=0.1");
  GlossyLight glossy(scene, settings);
  std::uint64_t frame_index = 0;
  const auto spoil = [&](std::vector<Vec3>& light, const Image& right) {
    const std::vector<Vec3> with_p = right.colours("indirect_from_glossy");
    const std::vector<Vec3> without_p = glossy.without_p(frame_index++);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += without_p[i] - with_p[i];
  };
  EXPECT_FALSE(test_frames(scene, settings, settings, spoil).passed);
}

}  // namespace
}  // namespace luciole::test
