// SPDX-License-Identifier: Apache-2.0
// Videos: what is handed to ffmpeg, and what happens where it fails. A script stands in for it.
#include <sys/stat.h>

#include "apps/command_line/run_program.h"
#include "image/exr.h"
#include "image/tone_curve.h"

namespace luciole {
namespace {

class VideoCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    fs::create_directories(folder_ / "bin");
    path_ = std::getenv("PATH");
    setenv("PATH", ((folder_ / "bin").string() + ":" + path_).c_str(), 1);
  }
  void TearDown() override { setenv("PATH", path_.c_str(), 1); }

  // The script runs in the test's folder; $out is the file that it is asked to write.
  void put_ffmpeg(const std::string& script) {
    const fs::path name = folder_ / "bin/ffmpeg";
    std::ofstream(name) << "#!/bin/sh\necho \"$@\" > words\nfor word; do out=${word#file:}; done\n" << script << "\n";
    chmod(name.c_str(), 0755);
  }

  std::vector<std::string> film(const std::string& frames, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"render", "recipe:cornell", "--size", "64x36",   "--vpls",
                                      "256",    "--frames",       frames,   "--video", "out/box.mp4"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  std::string path_;
};

TEST_F(VideoCommand, gets_size_rate_and_the_bytes_of_the_pictures) {
  put_ffmpeg("cat > \"$out\"");
  const Outcome outcome = run(film("3-5", {"-o", "out/f-####.exr"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.complained;
  const std::string words = content(folder_ / "words");
  for (const char* expected : {"-f rawvideo", "-pix_fmt rgb24", "-video_size 64x36", "-framerate 30", "-i pipe:0"}) {
    EXPECT_NE(words.find(expected), std::string::npos) << words;
  }
  EXPECT_EQ(files_in_out(), 4u);  // nothing partial
  std::string expected;
  for (const char* name : {"out/f-0003.exr", "out/f-0004.exr", "out/f-0005.exr"}) {
    const Result<Image> frame = read_exr(folder_ / name);
    ASSERT_TRUE(frame.has_value());
    for (const Vec3 shown : to_display(frame->colours(""), 1, ToneCurve::pbr_neutral)) {
      for (const float channel : {shown.x, shown.y, shown.z}) {
        expected += static_cast<char>(static_cast<std::uint8_t>(srgb_encode(channel) * 255.0f + 0.5f));
      }
    }
  }
  EXPECT_EQ(expected.size(), 3u * 64 * 36 * 3);
  EXPECT_TRUE(content(folder_ / "out/box.mp4") == expected);
}

TEST_F(VideoCommand, without_ffmpeg_is_refused_before_anything_is_loaded) {
  setenv("PATH", (folder_ / "bin").c_str(), 1);
  EXPECT_REFUSED(1, film("0-1"));
  EXPECT_NE(content(folder_ / "complained").find("ffmpeg"), std::string::npos);
}

TEST_F(VideoCommand, is_refused_where_it_cannot_be) {
  put_ffmpeg("cat > \"$out\"");
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "--video", "out/box.mp4"});
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "--frames", "0-1", "--size", "63x36", "--video", "out/box.mp4"});
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "--frames", "0-1", "--video", "out/box"});
  EXPECT_REFUSED(1, {"render", "recipe:cornell", "--frames", "0-1", "--video", "nowhere/box.mp4"});
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "--method", "path", "--video", "out/box.mp4", "-o", "out/a.exr"});
}

// Whatever it does, it is one sentence, exit code 1, no file and no process left, and no hang.
TEST_F(VideoCommand, of_an_ffmpeg_that_fails_ends_with_what_it_said) {
  for (const char* script :
       {"echo 'no such codec' >&2; exit 3", "head -c 100 > /dev/null; echo 'no such codec' >&2; exit 0",
        "cat > /dev/null; echo 'no such codec' >&2; exit 3", "echo 'no such codec' >&2; kill -9 $$",
        "cat > /dev/null; echo 'no such codec' >&2"}) {
    put_ffmpeg(script);
    EXPECT_REFUSED(1, film("0-19"));
    EXPECT_NE(content(folder_ / "complained").find("no such codec"), std::string::npos) << script;
  }
}

TEST_F(VideoCommand, interrupted_has_the_frames_that_were_done) {
  put_ffmpeg("cat > \"$out\"; echo whole >> out/end");
  const Outcome outcome = interrupt(start(film("0-100000", {"--verbose"})), "ms frame");
  EXPECT_EQ(outcome.exit_code, 130) << outcome.complained;
  const std::size_t frame_bytes = 64 * 36 * 3, size = content(folder_ / "out/box.mp4").size();
  EXPECT_GE(size, frame_bytes);
  EXPECT_EQ(size % frame_bytes, 0u);
  EXPECT_EQ(content(folder_ / "out/end"), "whole\n");  // it was not interrupted itself
}

}  // namespace
}  // namespace luciole
