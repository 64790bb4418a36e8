// SPDX-License-Identifier: Apache-2.0
// Runs the program as a user does: what it writes, what it says, and what it leaves behind.
#include <nlohmann/json.hpp>

#include "apps/command_line/run_program.h"
#include "image/exr.h"

namespace luciole {
namespace {

// Small enough to be quick, large enough for tiles and interleaving.
std::vector<std::string> small_render(std::vector<std::string> more) {
  std::vector<std::string> words = {"render", "recipe:cornell", "--size", "64x36", "--vpls", "256"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(CommandLine, renders_pictures_and_statistics) {
  const Outcome outcome = run(small_render({"-o", "out/a.exr", "-o", "out/a.png", "--statistics", "out/a.json"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.complained;
  EXPECT_EQ(outcome.said, "");
  EXPECT_EQ(outcome.complained, "");  // quiet in a pipe
  EXPECT_EQ(files_in_out(), 3u);
  const Result<Image> picture = read_exr(folder_ / "out/a.exr");
  ASSERT_TRUE(picture.has_value()) << picture.error().message;
  EXPECT_EQ(picture->width, 64u);
  EXPECT_EQ(picture->height, 36u);
  EXPECT_EQ(picture->metadata.at("luciole.vpls"), "256");
  EXPECT_EQ(content(folder_ / "out/a.png").substr(1, 3), "PNG");
  const auto statistics = nlohmann::json::parse(content(folder_ / "out/a.json"));
  for (const char* key :
       {"passes_ms", "frame_ms", "lights", "lights_listed_per_pixel", "lights_accepted_per_pixel",
        "false_positives_per_pixel", "list_length", "light_pixel_evaluations_per_second", "peak_memory_bytes",
        "settings", "seed", "load_ms", "bvh_ms", "processor", "instruction_set", "threads", "version"}) {
    EXPECT_TRUE(statistics.contains(key)) << key;
  }
  for (const char* key : {"total", "diffuse", "glossy"}) {
    EXPECT_TRUE(statistics["lights_listed_per_pixel"].contains(key)) << key;
  }
  EXPECT_GT(statistics["lights_accepted_per_pixel"]["total"].get<double>(), 0);
}

TEST_F(CommandLine, equal_runs_write_equal_files_and_other_seeds_do_not) {
  ASSERT_EQ(run(small_render({"-o", "out/a.exr", "--threads", "1"})).exit_code, 0);
  ASSERT_EQ(run(small_render({"-o", "out/b.exr", "--threads", "2"})).exit_code, 0);
  ASSERT_EQ(run(small_render({"-o", "out/c.exr", "--seed", "2"})).exit_code, 0);
  EXPECT_EQ(content(folder_ / "out/a.exr"), content(folder_ / "out/b.exr"));
  const Outcome same = run({"compare", "out/a.exr", "out/b.exr", "--json"});
  const Outcome other = run({"compare", "out/a.exr", "out/c.exr", "--json"});
  EXPECT_EQ(nlohmann::json::parse(same.said)["rmse"].get<double>(), 0);
  EXPECT_EQ(nlohmann::json::parse(same.said)["mean_ratio"].get<double>(), 1);
  EXPECT_GT(nlohmann::json::parse(other.said)["relmse"].get<double>(), 0);
}

TEST_F(CommandLine, accumulating_gives_the_mean_of_the_frames_and_their_variance) {
  ASSERT_EQ(run(small_render({"-o", "out/f-####.exr", "--frames", "0-2"})).exit_code, 0);
  ASSERT_EQ(run(small_render({"-o", "out/mean.exr", "--accumulate", "3", "--layers", "variance", "--statistics",
                              "out/mean.json"}))
                .exit_code,
            0);
  const Result<Image> mean = read_exr(folder_ / "out/mean.exr");
  ASSERT_TRUE(mean.has_value());
  std::vector<Image> frames;
  for (const char* name : {"out/f-0000.exr", "out/f-0001.exr", "out/f-0002.exr"}) {
    frames.push_back(*read_exr(folder_ / name));
  }
  bool frames_differ = false;
  for (std::size_t i = 0; i < mean->pixel_count(); ++i) {
    const double a = frames[0].channels["G"][i], b = frames[1].channels["G"][i], c = frames[2].channels["G"][i];
    const double expected = (a + b + c) / 3;
    const auto sq = [expected](double x) { return (x - expected) * (x - expected); };
    EXPECT_FLOAT_EQ(mean->channels.at("G")[i], static_cast<float>(expected));
    EXPECT_NEAR(mean->channels.at("variance.G")[i], (sq(a) + sq(b) + sq(c)) / 2, 1e-6 * (1 + a * a));
    frames_differ |= a != b;
  }
  EXPECT_TRUE(frames_differ);  // else the mean proves nothing
  EXPECT_EQ(nlohmann::json::parse(content(folder_ / "out/mean.json"))["frames"].size(), 3u);
}

// A shot whose camera moves a metre to the right, or rests at `eye` if the path is empty.
std::string shot_text(const std::string& camera) {
  return "scene = 'recipe:cornell'\nframes_per_second = 4\n[camera]\nvertical_fov_degrees = 39\n" + camera +
         "\n[settings]\nvpls = 256\nsize = [64, 36]\n";
}

std::string keys_between(const std::string& from, const std::string& to) {
  return "[[camera.key]]\ntime = 0\neye = " + from + "\ntarget = [0, 1, 0]\n[[camera.key]]\ntime = 1\neye = " + to +
         "\ntarget = [0, 1, 0]\n";
}

TEST_F(CommandLine, a_camera_moves_along_its_path_and_each_frame_is_the_same_alone) {
  std::ofstream(folder_ / "walk.toml") << shot_text(keys_between("[0, 1, 3.9]", "[1, 1, 3.9]"));
  std::ofstream(folder_ / "stay.toml") << shot_text(keys_between("[0, 1, 3.9]", "[0, 1, 3.9]"));
  std::ofstream(folder_ / "rest.toml") << shot_text("eye = [0, 1, 3.9]\ntarget = [0, 1, 0]\n");
  ASSERT_EQ(run({"render", "walk.toml", "--frames", "0-4", "-o", "out/walk-####.png", "--statistics", "out/walk.json"})
                .exit_code,
            0);
  ASSERT_EQ(run({"render", "walk.toml", "--frames", "3", "-o", "out/alone-####.png"}).exit_code, 0);
  EXPECT_EQ(content(folder_ / "out/walk-0003.png"), content(folder_ / "out/alone-0003.png"));
  for (const char* shot : {"stay", "rest"}) {
    const std::string name = shot;
    ASSERT_EQ(run({"render", name + ".toml", "--frames", "0-4", "-o", "out/" + name + "-####.png"}).exit_code, 0);
  }
  for (const char* frame : {"0000", "0003", "0004"}) {
    const auto picture = [&](const std::string& name) {
      return content(folder_ / ("out/" + name + "-" + frame + ".png"));
    };
    EXPECT_EQ(picture("stay"), picture("rest"));
    EXPECT_EQ(picture("walk") == picture("rest"), frame == std::string("0000"));  // else the comparison proves nothing
  }
  const auto statistics = nlohmann::json::parse(content(folder_ / "out/walk.json"));
  ASSERT_EQ(statistics["frames"].size(), 5u);
  EXPECT_TRUE(statistics["frames"][4].contains("passes_ms"));
  // Another camera of the command line stands still.
  ASSERT_EQ(
      run({"render", "walk.toml", "--camera", "0,1,3.9/0,1,0/39", "--frames", "4", "-o", "out/own-####.png"}).exit_code,
      0);
  EXPECT_EQ(content(folder_ / "out/own-0004.png"), content(folder_ / "out/rest-0004.png"));
}

TEST_F(CommandLine, misuse_is_refused_with_one_sentence_and_exit_code_2) {
  EXPECT_REFUSED(2, {});
  EXPECT_REFUSED(2, {"dance"});
  EXPECT_REFUSED(2, {"render"});
  EXPECT_REFUSED(2, {"render", "recipe:cornell"});
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--brightness", "3"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.gif"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.png", "--layers", "direct"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--layers", "smell"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--layers", "variance"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--delta", "0.1", "--error-bound", "0.1"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--bounds", "cube"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--interleave", "3"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--frames", "1-3"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a-####.exr", "--frames", "3-1"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--camera", "left"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--camera", "0,0,0/0,0,0/60"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--accumulate", "0"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--accumulate", "4", "--temporal", "4"}));
  EXPECT_REFUSED(2, small_render({"-o", "out/a.exr", "--temporal", "0"}));
  EXPECT_REFUSED(2, {"render", "recipe:cornell?colour=3", "-o", "out/a.exr"});
  EXPECT_REFUSED(2, {"render", "recipe:castle", "-o", "out/a.exr"});
  EXPECT_REFUSED(2, {"make", "ring", "alpha", "-o", "out/a.glb"});
  EXPECT_REFUSED(2, {"make", "ring", "-o", "out/a.obj"});
  EXPECT_REFUSED(2, {"make", "ring", "--size", "64x36", "-o", "out/a.glb"});
  EXPECT_REFUSED(2, {"make", "lamps", "matte=1", "--bounces", "0", "-o", "out/a.pbrt"});
}

TEST_F(CommandLine, zero_and_huge_sizes_are_refused_before_anything_is_loaded) {
  for (const char* size : {"0x36", "64x0", "64", "x", "-1x4", "16385x4", "4x99999999999", "16384x16384"}) {
    EXPECT_REFUSED(2, {"render", "recipe:cornell", "-o", "out/a.exr", "--vpls", "4294967295", "--size", size});
  }
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "-o", "out/a.exr", "--vpls", "0"});
}

TEST_F(CommandLine, missing_files_and_unwritable_outputs_end_with_exit_code_1) {
  EXPECT_REFUSED(1, {"render", "nowhere.gltf", "-o", "out/a.exr"});
  EXPECT_REFUSED(1, {"render", "no-such-shot", "-o", "out/a.exr"});
  EXPECT_REFUSED(1, {"info", "nowhere.glb"});
  EXPECT_REFUSED(1, {"compare", "nowhere.exr", "nowhere.exr"});
  EXPECT_REFUSED(1, small_render({"-o", "nowhere/a.exr"}));
  EXPECT_REFUSED(1, small_render({"-o", "out/a.exr", "--statistics", "nowhere/a.json"}));
  EXPECT_REFUSED(1, small_render({"-o", "out/a.exr", "--environment", "nowhere.exr"}));
  fs::create_directories(folder_ / "folder.exr");
  EXPECT_REFUSED(1, small_render({"-o", "folder.exr"}));
}

TEST_F(CommandLine, bad_scenes_end_with_exit_code_3) {
  std::ofstream(folder_ / "empty.gltf") << R"({"asset":{"version":"2.0"}})";
  EXPECT_REFUSED(3, {"render", "empty.gltf", "-o", "out/a.exr"});
  std::ofstream(folder_ / "broken.gltf") << "{";
  EXPECT_REFUSED(3, {"render", "broken.gltf", "-o", "out/a.exr"});
  std::ofstream(folder_ / "broken.toml") << "scene = 'recipe:ring'\nlens = 3\n";
  EXPECT_REFUSED(3, {"render", "broken.toml", "-o", "out/a.exr"});
  std::ofstream(folder_ / "settings.toml") << "scene = 'recipe:ring'\n[settings]\nvplz = 3\n";
  EXPECT_REFUSED(3, {"render", "settings.toml", "-o", "out/a.exr"});
  EXPECT_REFUSED(3, {"make", "lamps", "count=10", "-o", "out/a.pbrt"});
  std::ofstream(folder_ / "path.toml") << shot_text("[[camera.key]]\ntime = 0\neye = [0, 1, 3]\ntarget = [0, 1, 0]\n");
  EXPECT_REFUSED(3, {"render", "path.toml", "-o", "out/a.exr"});
  // The control: the same file without the fault is rendered.
  std::ofstream(folder_ / "right.toml") << "scene = 'recipe:cornell'\n[settings]\nvpls = 64\nsize = [16, 9]\n";
  EXPECT_EQ(run({"render", "right.toml", "-o", "out/a.exr"}).exit_code, 0);
  EXPECT_EQ(files_in_out(), 1u);
}

TEST_F(CommandLine, a_recipe_comes_back_from_its_file) {
  ASSERT_EQ(run({"make", "ring", "alpha=0.1", "-o", "out/ring.glb"}).exit_code, 0);
  const Outcome recipe = run({"info", "recipe:ring?alpha=0.1"}), file = run({"info", "out/ring.glb"});
  ASSERT_EQ(file.exit_code, 0) << file.complained;
  const auto triangles = [](const std::string& text) { return text.substr(text.find("triangles"), 40); };
  EXPECT_EQ(triangles(recipe.said), triangles(file.said));
}

TEST_F(CommandLine, a_matte_recipe_is_written_for_pbrt) {
  const Outcome made = run({"make", "lamps", "count=10", "matte=1", "--size", "64x36", "--bounces", "1", "--samples",
                            "8", "-o", "out/lamps.pbrt"});
  ASSERT_EQ(made.exit_code, 0) << made.complained;
  const std::string text = content(folder_ / "out/lamps.pbrt");
  for (const char* part : {"\"integer xresolution\" [ 64 ]", "\"integer yresolution\" [ 36 ]",
                           "\"integer maxdepth\" [ 1 ]", "\"integer pixelsamples\" [ 8 ]", "\"lamps_0.ply\""}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_TRUE(fs::exists(folder_ / "out/lamps_0.ply"));
}

TEST_F(CommandLine, interrupted_accumulation_writes_what_is_complete) {
  const Outcome outcome =
      interrupt(start(small_render({"-o", "out/a.exr", "--accumulate", "1000000", "--verbose"})), "ms frame");
  EXPECT_EQ(outcome.exit_code, 130) << outcome.complained;
  const Result<Image> picture = read_exr(folder_ / "out/a.exr");
  ASSERT_TRUE(picture.has_value()) << outcome.complained;
  EXPECT_GE(std::stoul(picture->metadata.at("luciole.accumulated_frames")), 1u);
  EXPECT_LT(std::stoul(picture->metadata.at("luciole.accumulated_frames")), 1000000u);
}

TEST_F(CommandLine, interrupted_in_its_only_frame_writes_nothing) {
  const Outcome outcome =
      interrupt(start({"render", "recipe:cornell", "--size", "1024x1024", "--vpls", "65536", "--culling", "none",
                       "--ranges", "infinite", "--interleave", "1", "-o", "out/a.exr"}),
                "");
  EXPECT_EQ(outcome.exit_code, 130) << outcome.complained;
  EXPECT_EQ(std::count(outcome.complained.begin(), outcome.complained.end(), '\n'), 1) << outcome.complained;
  EXPECT_EQ(files_in_out(), 0u);
}

TEST_F(CommandLine, every_command_explains_itself_with_examples) {
  for (const char* command : {"render", "info", "make", "merge", "compare", "report"}) {
    const Outcome outcome = run({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.said.find("Examples:\n  luciole " + std::string(command)), std::string::npos) << outcome.said;
  }
  EXPECT_EQ(run({"--version"}).said.rfind("luciole ", 0), 0u);
}

}  // namespace
}  // namespace luciole
