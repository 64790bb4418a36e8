// SPDX-License-Identifier: Apache-2.0
// What the tests of unbiasedness share: bundled scenes, and the image z-test of many frames.
#pragma once
#include <gtest/gtest.h>

#include <functional>

#include "image/z_test.h"
#include "real_time/frame.h"
#include "scene/recipes/recipes.h"

namespace luciole::test {

inline constexpr std::uint32_t kFrames = 256;

struct Stage {
  std::shared_ptr<const Scene> scene;
  Camera camera;
  PrimaryLights primaries;
};

inline Stage stage(const std::string& address) {
  Result<Scene> scene = make_recipe_from_address(address);
  EXPECT_TRUE(scene.has_value()) << address;
  Stage s;
  s.scene = std::make_shared<const Scene>(std::move(*scene));
  s.camera = s.scene->cameras.at(0);
  if (!s.scene->lights.empty()) s.primaries = {s.scene->lights[0]};
  return s;
}

inline Settings test_settings(std::uint32_t interleave) {
  Settings settings;
  settings.width = 48, settings.height = 32;
  settings.vpls = 4096;
  settings.interleave = interleave;
  settings.filter = Filter::none;
  settings.exposure = 2.0f;
  settings.delta = 0.02f;
  return settings;
}

inline Renderer renderer_of(const Stage& stage, const Settings& settings) {
  Result<Renderer> renderer = Renderer::create(stage.scene, stage.camera, stage.primaries, settings);
  EXPECT_TRUE(renderer.has_value());
  return std::move(*renderer);
}

inline EstimatorStatistics expectation_of(const Stage& stage, const Settings& settings,
                                          std::uint32_t frames = kFrames) {
  Renderer renderer = renderer_of(stage, settings);
  const Result<Frame> frame = renderer.render(0, {"reference", "predicted_variance", "predicted_accepted"});
  Result<FrameExpectation> expectation = frame_expectation(frame->layers);
  EXPECT_TRUE(expectation.has_value());
  return {std::move(*expectation), frames};
}

// The noisy light of many frames against what the prediction says of it.
//   spoil  changes a frame's light as a wrong program would; given the frame's layers
inline ZTestReport test_frames(const Stage& stage, const Settings& expected, const Settings& rendered,
                               const std::function<void(std::vector<Vec3>&, const Image&)>& spoil = nullptr,
                               std::uint32_t frames = kFrames) {
  EstimatorStatistics statistics = expectation_of(stage, expected, frames);
  Renderer renderer = renderer_of(stage, rendered);
  for (std::uint32_t i = 0; i < frames; ++i) {
    const Result<Frame> frame = renderer.render(i, {"unfiltered", "indirect_from_glossy"});
    std::vector<Vec3> light = frame->layers.colours("unfiltered");
    if (spoil) spoil(light, frame->layers);
    statistics.add(light);
  }
  return image_z_test(statistics);
}

}  // namespace luciole::test
