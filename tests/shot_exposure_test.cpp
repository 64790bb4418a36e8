// SPDX-License-Identifier: Apache-2.0
// Every shot is exposed alike, so that delta and the light counts mean the same in all of them: the mean display-linear
// luminance of its picture is 0.18 +- 0.02. No pixel of any is infinite or no number.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "image/tone_curve.h"
#include "real_time/frame.h"
#include "real_time/settings_text.h"
#include "scene/default_lights.h"
#include "shot/open_shot.h"

namespace luciole {
namespace {

SearchFolders folders() {
  SearchFolders found;
  found.shots = {std::filesystem::path(LUCIOLE_SOURCE_DIR) / "shots"};
  if (const char* scenes = std::getenv("LUCIOLE_SCENES")) found.scenes = {scenes};
  return found;
}

// Unfiltered and not interleaved: the mean of this picture is that of the reference, up to the roulette's noise.
double exposed_mean(const Shot& shot, const OpenedShot& opened) {
  const Result<Settings> settings =
      settings_from(shot.settings, {{"size", "240x135"}, {"interleave", "1"}, {"filter", "none"}});
  EXPECT_TRUE(settings.has_value());
  PrimaryLights primaries = opened.primary;
  if (primaries.empty())
    for (const std::size_t i : strongest_lights(opened.scene)) primaries.push_back(opened.scene.lights[i]);
  Result<Renderer> renderer =
      Renderer::create(std::make_shared<const Scene>(opened.scene), opened.camera, primaries, *settings);
  EXPECT_TRUE(renderer.has_value());
  const Result<Frame> frame = renderer->render(0);
  EXPECT_EQ(frame->statistics.pixels_not_finite, 0u);
  double sum = 0;
  for (const Vec3& pixel : frame->picture) sum += luminance(pixel);
  return settings->exposure * sum / static_cast<double>(frame->picture.size());
}

class ShotExposure : public testing::TestWithParam<std::string> {};

TEST_P(ShotExposure, gives_a_mean_luminance_of_eighteen_percent) {
  const Result<Shot> shot = find_shot(GetParam(), folders());
  ASSERT_TRUE(shot.has_value()) << shot.error().message;
  if (shot->scene.rfind("recipe:", 0) != 0 && std::getenv("LUCIOLE_SCENES") == nullptr) {
    GTEST_SKIP() << "LUCIOLE_SCENES is not set: " << shot->scene << " is not bundled";
  }
  const Result<OpenedShot> opened = open_shot(*shot, folders());
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  EXPECT_NEAR(exposed_mean(*shot, *opened), 0.18, 0.02);
}

INSTANTIATE_TEST_SUITE_P(AllShots, ShotExposure, testing::ValuesIn(shot_names(folders())));

}  // namespace
}  // namespace luciole
