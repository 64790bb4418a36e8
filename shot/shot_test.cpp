// SPDX-License-Identifier: Apache-2.0
#include "shot/shot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "real_time/settings_text.h"
#include "shot/open_shot.h"

namespace luciole {
namespace {

const char* const kHall = R"(
scene = "recipe:ring?alpha=0.1"
scale = 0.01
[camera]
eye = [0, 1.5, 4]
target = [0, 1.5, 0.0]
vertical_fov_degrees = 60
[[primary]]
kind = "sun"
direction = [0, -2, 0]
irradiance = [3, 2, 1]
[[primary]]
kind = "spot"
position = [0, 5, 0]
target = [0, 0, 0]
intensity = [100, 90, 80]
inner_degrees = 20
outer_degrees = 30
[[materials]]
name = "metal*"
ggx_alpha = 0.1
metallic = 1
[settings]
size = [1920, 1080]
delta = 0.001
bounds = "spheroid"
jitter = true
environment = [0.1, 0.2, 0.3]
)";

TEST(Shot, reads_every_key) {
  const Result<Shot> shot = parse_shot(kHall, "hall.toml");
  ASSERT_TRUE(shot.has_value()) << shot.error().message;
  EXPECT_EQ(shot->scene, "recipe:ring?alpha=0.1");
  EXPECT_EQ(shot->scale, 0.01f);
  ASSERT_TRUE(shot->camera.has_value());
  EXPECT_EQ(shot->camera->eye.z, 4.0f);
  EXPECT_EQ(shot->camera->forward.z, -1.0f);
  EXPECT_FLOAT_EQ(shot->camera->vertical_fov, std::numbers::pi_v<float> / 3);
  ASSERT_EQ(shot->primary.size(), 2u);
  EXPECT_EQ(shot->primary[0].kind, PunctualLight::Kind::directional);
  EXPECT_EQ(shot->primary[0].direction.y, -1.0f);
  EXPECT_EQ(shot->primary[1].direction.y, -1.0f);
  EXPECT_FLOAT_EQ(shot->primary[1].cos_outer, std::sqrt(0.75f));
  ASSERT_EQ(shot->materials.size(), 1u);
  EXPECT_EQ(shot->materials[0].ggx_alpha, 0.1f);
  ASSERT_TRUE(shot->environment.has_value());
  EXPECT_EQ(shot->environment->z, 0.3f);
  const std::vector<std::pair<std::string, std::string>> settings = {
      {"bounds", "spheroid"}, {"delta", "0.001"}, {"jitter", "true"}, {"size", "1920x1080"}};
  EXPECT_EQ(shot->settings, settings);
}

TEST(Shot, bad_shots_are_refused_with_a_sentence_that_names_the_place) {
  const std::pair<const char*, const char*> bad[] = {
      {"scene = ", "line 1"},
      {"scale = 1", "'scene'"},
      {"scene = 'a'\nscale = 0", "'scale'"},
      {"scene = 'a'\nscale = nan", "'scale'"},
      {"scene = 'a'\nlens = 3", "no key 'lens'; valid keys: scene, scale"},
      {"scene = 'a'\ncamera = 3", "[camera]"},
      {"scene = 'a'\n[camera]\neye = [0, 0]\ntarget = [1, 1, 1]", "three numbers in 'eye'"},
      {"scene = 'a'\n[camera]\neye = [0, 0, 0]\ntarget = [1, 1, 1]\nfov = 3", "no key 'fov'"},
      {"scene = 'a'\n[[primary]]\nkind = 'laser'", "one of sun, spot, point"},
      {"scene = 'a'\n[[primary]]\nkind = 'sun'\nirradiance = [1, 1, 1]", "'target' or 'direction'"},
      {"scene = 'a'\n[[primary]]\nkind = 'point'\nposition = [1, 1, 1]\nintensity = [1, -1, 1]", "'intensity'"},
      {"scene = 'a'\n[[materials]]\nname = 'x'", "'ggx_alpha' or 'metallic'"},
      {"scene = 'a'\n[[materials]]\nname = 'x'\nmetallic = 2", "at most 1"},
      {"scene = 'a'\n[settings]\nsize = [1, 2, 3]", "'size'"}};
  for (const auto& [text, expected] : bad) {
    const Result<Shot> shot = parse_shot(text, "bad.toml");
    ASSERT_FALSE(shot.has_value()) << text;
    EXPECT_EQ(shot.error().message.rfind("bad.toml:", 0), 0u) << shot.error().message;
    EXPECT_NE(shot.error().message.find(expected), std::string::npos) << shot.error().message;
    EXPECT_EQ(shot.error().message.find('\n'), std::string::npos) << shot.error().message;
  }
}

TEST(Shot, a_spot_with_its_cones_exchanged_is_refused) {
  std::string text = kHall;
  ASSERT_TRUE(parse_shot(text, "hall.toml").has_value());
  text.replace(text.find("inner_degrees = 20"), 18, "inner_degrees = 40");
  EXPECT_FALSE(parse_shot(text, "hall.toml").has_value());
}

TEST(Shot, one_table_of_materials_is_for_all_of_them) {
  const Result<Shot> shot = parse_shot("scene = 'a'\n[materials]\nmetallic = 1", "all.toml");
  ASSERT_TRUE(shot.has_value()) << shot.error().message;
  ASSERT_EQ(shot->materials.size(), 1u);
  EXPECT_EQ(shot->materials[0].name_pattern, "*");
  EXPECT_FALSE(parse_shot("scene = 'a'\n[materials]\nname = 'x'\nmetallic = 1", "all.toml").has_value());
}

TEST(MaterialPattern, stars_and_question_marks_match_as_in_file_names) {
  for (const char* pattern : {"steel", "*", "s*", "*l", "s?ee*", "st*e*l", "*****"}) {
    EXPECT_TRUE(matches_pattern("steel", pattern)) << pattern;
  }
  for (const char* pattern : {"", "stee", "steels", "?", "s?eel?", "*x*", "Steel"}) {
    EXPECT_FALSE(matches_pattern("steel", pattern)) << pattern;
  }
}

TEST(MaterialOverride, a_pattern_without_any_match_is_refused) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[0].name = "brass", scene.materials[1].name = "brick";
  ASSERT_TRUE(override_materials(scene, {{"bra*", 0.2f, std::nullopt}}).has_value());
  EXPECT_EQ(scene.materials[0].ggx_alpha_override, 0.2f);
  EXPECT_LT(scene.materials[0].metallic_override, 0);
  EXPECT_LT(scene.materials[1].ggx_alpha_override, 0);
  EXPECT_FALSE(override_materials(scene, {{"brsas", 0.2f, std::nullopt}}).has_value());
}

TEST(OpenShot, a_light_that_the_shot_repeats_does_not_shine_twice) {
  const char* const text = R"(
scene = "recipe:cornell"
[[primary]]
kind = "spot"
position = [0.0, 1.98, 0.0]
target = [0.0, 0.0, 0.0]
intensity = [4, 3.6, 3]
inner_degrees = 60
outer_degrees = 88
)";
  const Result<Shot> shot = parse_shot(text, "box.toml");
  ASSERT_TRUE(shot.has_value()) << shot.error().message;
  const Result<OpenedShot> opened = open_shot(*shot, {});
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  EXPECT_EQ(opened->scene.lights.size(), 0u);
  Shot brighter = *shot;
  brighter.primary[0].intensity.x = 5;
  EXPECT_EQ(open_shot(brighter, {})->scene.lights.size(), 1u);
}

TEST(OpenShot, what_a_scene_lacks_is_filled_in_and_said) {
  Shot shot;
  shot.scene = "recipe:cornell";
  const Result<OpenedShot> opened = open_shot(shot, {});
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  EXPECT_TRUE(opened->notes.empty());
  EXPECT_EQ(opened->scene.lights.size(), 1u);
  shot.scale = 3;
  const Result<OpenedShot> larger = open_shot(shot, {});
  EXPECT_FLOAT_EQ(larger->scene.bounds().diagonal(), 3 * opened->scene.bounds().diagonal());
  EXPECT_FLOAT_EQ(larger->camera.eye.z, 3 * opened->camera.eye.z);
}

// Shots that ship must be right without anybody rendering them; their scene files may be elsewhere.
TEST(BundledShots, are_all_understood) {
  const SearchFolders folders{{std::filesystem::path(LUCIOLE_SOURCE_DIR) / "shots"}, {}};
  const std::vector<std::string> names = shot_names(folders);
  EXPECT_GE(names.size(), 5u);
  for (const std::string& name : names) {
    const Result<Shot> shot = find_shot(name, folders);
    ASSERT_TRUE(shot.has_value()) << shot.error().message;
    EXPECT_TRUE(shot->camera.has_value() || shot->scene.rfind("recipe:", 0) == 0) << name;  // recipes have cameras
    const Result<Settings> settings = settings_from(shot->settings, {});
    EXPECT_TRUE(settings.has_value()) << name << ": " << settings.error().message;
  }
}

TEST(FindShot, an_unknown_name_lists_the_shots_that_exist) {
  const SearchFolders folders{{std::filesystem::path(LUCIOLE_SOURCE_DIR) / "shots"}, {}};
  const Result<Shot> shot = find_shot("no-such-shot", folders);
  ASSERT_FALSE(shot.has_value());
  EXPECT_NE(shot.error().message.find("cornell"), std::string::npos) << shot.error().message;
  EXPECT_FALSE(find_shot("nowhere/scene.gltf", folders).has_value());
  EXPECT_FALSE(find_shot(LUCIOLE_SOURCE_DIR, folders).has_value());
}

}  // namespace
}  // namespace luciole
