// SPDX-License-Identifier: Apache-2.0
// The camera meets its keys, moves smoothly between them, and rests where nothing moves.
#include "shot/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "shot/shot.h"

namespace luciole {
namespace {

const char* const kWalk = R"(
scene = "recipe:cornell"
frames_per_second = 10
[camera]
vertical_fov_degrees = 50
[[camera.key]]
time = 1
eye = [0, 1, 0]
target = [0, 1, -5]
[[camera.key]]
time = 2
eye = [1, 1, 0]
target = [0, 1, -5]
vertical_fov_degrees = 40
[[camera.key]]
time = 4
eye = [2, 3, 1]
target = [1, 1, -5]
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

CameraPath walk() {
  const Result<Shot> shot = parse_shot(kWalk, "walk.toml");
  EXPECT_TRUE(shot.has_value()) << shot.error().message;
  return shot->camera_path.value();
}

TEST(CameraPath, meets_its_keys_and_rests_outside_them) {
  const Result<Shot> shot = parse_shot(kWalk, "walk.toml");
  ASSERT_TRUE(shot.has_value()) << shot.error().message;
  EXPECT_EQ(shot->frames_per_second, 10);
  const CameraPath& path = *shot->camera_path;
  ASSERT_EQ(path.keys.size(), 3u);
  for (const CameraKey& key : path.keys) {
    const Camera met = camera_at(path, key.at * 10, 10), expected = look_at(key.eye, key.target, key.vertical_fov);
    EXPECT_EQ(length(met.eye - expected.eye), 0);
    EXPECT_EQ(length(met.forward - expected.forward), 0);
    EXPECT_EQ(met.vertical_fov, expected.vertical_fov);
  }
  EXPECT_FLOAT_EQ(path.keys[1].vertical_fov, 40 * std::numbers::pi_v<float> / 180);
  EXPECT_FLOAT_EQ(path.keys[2].vertical_fov, 50 * std::numbers::pi_v<float> / 180);
  EXPECT_EQ(camera_at(path, 0, 10).eye.y, 1);
  EXPECT_EQ(camera_at(path, 1e9, 10).eye.y, 3);
  EXPECT_EQ(shot->camera->eye.x, 0);  // of frame 0
}

// The velocity before a key is the one after it; a path of straight pieces fails this.
TEST(CameraPath, has_no_kink_at_a_key) {
  const CameraPath path = walk();
  const double at = 20, step = 1e-2;  // [frames]; the float eye keeps 1e-7 m
  const auto eye_x = [&](double frame) { return double(camera_at(path, frame, 10).eye.x); };
  const double before = (eye_x(at) - eye_x(at - step)) / step, after = (eye_x(at + step) - eye_x(at)) / step;
  // Key 2 lies between 0 m at 1 s and 2 m at 4 s; straight pieces would have 1 m/s before it and 0.5 m/s after it.
  EXPECT_NEAR(before, 2.0 / 3 / 10, 2e-4);
  EXPECT_NEAR(after, 2.0 / 3 / 10, 2e-4);
}

TEST(CameraPath, of_equal_keys_is_the_resting_camera_bit_for_bit) {
  CameraPath path;
  const CameraKey key{0, {0.1f, 0.7f, 3.3f}, {0.3f, 0.2f, -1.7f}, 0.83f};
  for (const double at : {0.0, 0.7, 1.9, 3.1}) path.keys.push_back(key), path.keys.back().at = at;
  const Camera resting = look_at(key.eye, key.target, key.vertical_fov);
  for (int frame = 0; frame < 100; ++frame) {
    const Camera camera = camera_at(path, frame, 24);
    EXPECT_EQ(length(camera.eye - resting.eye), 0);
    EXPECT_EQ(length(camera.forward - resting.forward), 0);
    EXPECT_EQ(camera.vertical_fov, resting.vertical_fov);
  }
  path.keys[2].eye.x += 1e-3f;  // the control
  EXPECT_NE(camera_at(path, 40, 24).eye.x, resting.eye.x);
}

TEST(CameraPath, keeps_the_field_of_view_between_those_of_the_keys) {
  CameraPath path;
  for (const float fov : {0.1f, 0.1f, 2.9f, 2.9f}) {
    path.keys.push_back({double(path.keys.size()), {0, 0, 0}, {0, 0, -1}, fov});
  }
  for (double frame = 0; frame <= 90; frame += 0.5) {
    const float fov = camera_at(path, frame, 30).vertical_fov;
    EXPECT_GE(fov, 0.1f);
    EXPECT_LE(fov, 2.9f);
  }
}

TEST(CameraPath, keys_may_be_at_frames_instead_of_seconds) {
  std::string text = kWalk;
  for (const char* time : {"time = 1", "time = 2", "time = 4"}) {
    text = replaced(text, time, std::string("frame = ") + time[7] + "0");
  }
  const Result<Shot> shot = parse_shot(text, "walk.toml");
  ASSERT_TRUE(shot.has_value()) << shot.error().message;
  for (const double frame : {10.0, 13.0, 27.0}) {
    EXPECT_FLOAT_EQ(camera_at(*shot->camera_path, frame, 10).eye.x, camera_at(walk(), frame, 10).eye.x);
  }
}

TEST(CameraPath, that_is_wrong_is_refused_with_file_and_key) {
  const std::tuple<const char*, const char*, const char*> bad[] = {
      {"time = 2", "time = 1", "[[camera.key]] 2 needs a 'time' after"},
      {"time = 4", "time = 1.5", "[[camera.key]] 3 needs a 'time' after"},
      {"time = 2", "time = inf", "[[camera.key]] 2 needs 'time'"},
      {"time = 1", "time = -1", "[[camera.key]] 1 needs 'time' of at least 0"},
      {"time = 2", "frame = 2", "[[camera.key]] 2 has 'frame', but the first key has 'time'"},
      {"time = 2\n", "", "[[camera.key]] 2 needs the key 'time'"},
      {"eye = [1, 1, 0]", "eye = [1, nan, 0]", "[[camera.key]] 2 needs finite numbers in 'eye'"},
      {"eye = [1, 1, 0]", "eye = [0, 1, -5]", "[[camera.key]] 2 needs a 'target' away from its 'eye'"},
      {"eye = [1, 1, 0]\n", "", "[[camera.key]] 2 needs the key 'eye'"},
      {"vertical_fov_degrees = 40", "roll = 3", "[[camera.key]] 2 has no key 'roll'; valid keys: time, "},
      {"vertical_fov_degrees = 50", "speed = 2", "[camera] has no key 'speed'"},
      {"vertical_fov_degrees = 50", "eye = [1, 1, 1]", "[camera] has 'eye' or 'target' beside [[camera.key]]"},
      {"frames_per_second = 10", "frames_per_second = 0", "'frames_per_second' above 0"}};
  for (const auto& [from, to, expected] : bad) {
    const Result<Shot> shot = parse_shot(replaced(kWalk, from, to), "walk.toml");
    ASSERT_FALSE(shot.has_value()) << to;
    EXPECT_EQ(shot.error().message.rfind("walk.toml: ", 0), 0u) << shot.error().message;
    EXPECT_NE(shot.error().message.find(expected), std::string::npos) << shot.error().message;
    EXPECT_EQ(shot.error().message.find('\n'), std::string::npos) << shot.error().message;
  }
  const char* const one = "scene = 'a'\n[[camera.key]]\ntime = 0\neye = [0, 0, 0]\ntarget = [1, 0, 0]\n";
  const Result<Shot> single = parse_shot(one, "one.toml");
  ASSERT_FALSE(single.has_value());
  EXPECT_EQ(single.error().message.rfind("one.toml: [camera] needs at least two [[camera.key]]", 0), 0u);
  EXPECT_FALSE(parse_shot("scene = 'a'\n[camera]\nkey = 3\n", "number.toml").has_value());
  EXPECT_FALSE(parse_shot("scene = 'a'\n[camera]\nkey = []\n", "none.toml").has_value());
}

}  // namespace
}  // namespace luciole
