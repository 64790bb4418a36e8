// SPDX-License-Identifier: Apache-2.0
// Frames of scenes in motion: what moves is where the frame's time puts it, whichever frames were rendered before.
#include <nlohmann/json.hpp>

#include "apps/command_line/run_program.h"

namespace luciole {
namespace {

class MotionCommand : public CommandLine {
 protected:
  // Frames of the moving box; whatever is noted would be a fault.
  int render(const std::string& frames, const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"render",   scene_,
                                      "--size",   "64x36",
                                      "--vpls",   "256",
                                      "--filter", "none",
                                      "--frames", frames,
                                      "-o",       "out/" + name + "-####.png",
                                      "-o",       "out/" + name + "-####.exr"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.complained, "");
    return outcome.exit_code;
  }
  std::string picture(const std::string& name) { return content(folder_ / ("out/" + name + ".png")); }

  std::string scene_ = "recipe:cornell?motion=1";
};

TEST_F(MotionCommand, a_frame_alone_is_the_frame_of_the_sequence) {
  ASSERT_EQ(render("40-42", "sequence", {"--statistics", "out/s.json"}), 0);
  ASSERT_EQ(render("42", "alone"), 0);
  EXPECT_EQ(picture("sequence-0042"), picture("alone-0042"));
  EXPECT_NE(picture("sequence-0041"), picture("alone-0042"));
  const auto statistics = nlohmann::json::parse(content(folder_ / "out/s.json"));
  EXPECT_GT(statistics["frames"][1]["scene_ms"].get<double>(), 0);
}

// Ranges do not change with --ranges infinite: whatever differs has moved.
TEST_F(MotionCommand, things_move_between_frames_and_rest_after_the_last_key) {
  const std::vector<std::string> all = {"--ranges", "infinite", "--interleave", "1"};
  ASSERT_EQ(render("0", "a", all), 0);
  ASSERT_EQ(render("30", "a", all), 0);
  ASSERT_EQ(render("240", "a", all), 0);  // 8 s: all is back where it was at frame 0, but for the second camera
  ASSERT_EQ(render("999", "a", all), 0);
  EXPECT_NE(picture("a-0000"), picture("a-0030"));
  EXPECT_EQ(picture("a-0240"), picture("a-0999"));
  scene_ = "recipe:cornell";
  ASSERT_EQ(render("0", "still", all), 0);
  ASSERT_EQ(render("30", "still", all), 0);
  EXPECT_EQ(picture("still-0000"), picture("still-0030"));
}

TEST_F(MotionCommand, a_camera_of_the_scene_moves_with_its_node) {
  const std::vector<std::string> nearer = {"--ranges", "infinite", "--interleave", "1", "--camera", "nearer"};
  ASSERT_EQ(render("0", "near", nearer), 0);
  ASSERT_EQ(render("0", "front", {"--ranges", "infinite", "--interleave", "1"}), 0);
  EXPECT_EQ(picture("near-0000"), picture("front-0000"));
  ASSERT_EQ(render("120", "near", nearer), 0);
  ASSERT_EQ(render("120", "front", {"--ranges", "infinite", "--interleave", "1"}), 0);
  EXPECT_NE(picture("near-0120"), picture("front-0120"));
}

// The file's nodes add some roundings, so that pictures differ a little; but less than from one frame to the next.
TEST_F(MotionCommand, a_file_moves_as_its_recipe) {
  ASSERT_EQ(run({"make", "cornell", "motion=1", "-o", "box.glb"}).exit_code, 0);
  const std::vector<std::string> all = {"--ranges", "infinite", "--interleave", "1"};
  ASSERT_EQ(render("74-76", "recipe", all), 0);
  scene_ = "box.glb";
  ASSERT_EQ(render("75", "file", all), 0);
  const auto distance = [&](const std::string& frame) {
    const Outcome compared = run({"compare", "out/file-0075.exr", "out/recipe-" + frame + ".exr", "--json"});
    return nlohmann::json::parse(compared.said)["rmse"].get<double>();
  };
  EXPECT_LT(distance("0075"), distance("0074"));
  EXPECT_LT(distance("0075"), distance("0076"));
}

}  // namespace
}  // namespace luciole
