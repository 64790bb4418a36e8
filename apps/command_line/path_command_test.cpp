// SPDX-License-Identifier: Apache-2.0
// luciole render --method path, run as a user does.
#include <nlohmann/json.hpp>
#include <random>

#include "apps/command_line/path_command_fixture.h"
#include "image/exr.h"
#include "offline/film/film_file.h"

namespace luciole {
namespace {

TEST_F(PathCommand, renders_a_picture_with_layers_metadata_and_statistics) {
  const Outcome outcome = run(small({"--samples", "8", "-o", "out/a.exr", "-o", "out/a.png", "--layers",
                                     "albedo,normal,variance", "--statistics", "out/a.json", "--lights", "power"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.complained;
  EXPECT_EQ(outcome.said + outcome.complained, "");  // quiet in a pipe
  const Result<Image> picture = read_exr(folder_ / "out/a.exr");
  ASSERT_TRUE(picture.has_value());
  for (const char* layer : {"", "albedo", "normal", "variance"}) EXPECT_TRUE(picture->has_layer(layer)) << layer;
  EXPECT_EQ(picture->channels.size(), 12u);
  for (const auto& [name, text] : std::map<std::string, std::string>{{"luciole.samples", "8"},
                                                                     {"luciole.method", "path"},
                                                                     {"luciole.shot", "recipe:cornell"},
                                                                     {"luciole.size", "17x9"},
                                                                     {"luciole.lights", "power"},
                                                                     {"luciole.bounces", "2"}}) {
    EXPECT_EQ(picture->metadata.at(name), text);
  }
  EXPECT_NE(picture->metadata.at("luciole.isa"), "auto");
  EXPECT_EQ(content(folder_ / "out/a.png").substr(1, 3), "PNG");
  const auto statistics = nlohmann::json::parse(content(folder_ / "out/a.json"));
  for (const char* key : {"rays_per_second", "paths_per_second", "peak_memory_bytes", "lights", "light_bytes", "bvh_ms",
                          "load_ms", "candidates_per_choice", "error_estimate", "settings", "notes", "threads",
                          "processor", "instruction_set", "version", "seed"}) {
    EXPECT_TRUE(statistics.contains(key)) << key;
  }
  EXPECT_EQ(statistics["samples_per_pixel"], 8);
  EXPECT_EQ(statistics["paths"], 8 * 17 * 9);
  EXPECT_GT(statistics["render_seconds"].get<double>(), 0);
  EXPECT_EQ(statistics["settings"]["lights"], "power");
}

TEST_F(PathCommand, one_and_many_threads_write_the_same_file_and_another_seed_does_not) {
  const std::string one = bytes("out/1.exr", small({"--samples", "5", "--threads", "1"}));
  EXPECT_EQ(bytes("out/2.exr", small({"--samples", "5", "--threads", "2"})), one);
  EXPECT_EQ(bytes("out/3.exr", small({"--samples", "5", "--threads", "3"})), one);
  EXPECT_NE(bytes("out/4.exr", small({"--samples", "5", "--seed", "2"})), one);
}

TEST_F(PathCommand, interrupted_runs_write_the_picture_so_far) {
  const pid_t child = start(
      small({"--samples", "100000000", "-o", "out/a.exr", "--checkpoint", "sums.exr", "--checkpoint-every", "0.2"}));
  ASSERT_TRUE(appears("sums.exr"));
  kill(child, SIGINT);
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 130) << outcome.complained;
  const Result<Image> picture = read_exr(folder_ / "out/a.exr");
  ASSERT_TRUE(picture.has_value()) << outcome.complained;
  const std::string samples = picture->metadata.at("luciole.samples");
  EXPECT_NE(outcome.complained.find("the picture of " + samples + " sample"), std::string::npos) << outcome.complained;
  EXPECT_EQ(std::to_string(read_film(folder_ / "sums.exr")->film.range().end), samples);
  // It is the picture that a run of so many samples gives.
  EXPECT_EQ(bytes("out/b.exr", small({"--samples", samples})), content(folder_ / "out/a.exr"));
}

TEST_F(PathCommand, kill_9_at_any_time_loses_nothing_but_time) {
  const Words more = {"--samples", "6000"};
  const Words kept = {"--checkpoint", "sums.exr", "--checkpoint-every", "0.02", "--resume", "-o", "out/resumed.exr"};
  const std::string whole = bytes("out/whole.exr", small(more));
  Words words = small(more);
  words.insert(words.end(), kept.begin(), kept.end());
  std::mt19937 random(1);
  std::uint64_t before = 0;
  int killed = 0;
  for (int round = 0; round < 5; ++round) {
    const pid_t child = start(words);
    std::this_thread::sleep_for(std::chrono::milliseconds(50 + random() % 400));
    kill(child, SIGKILL);
    killed += finish(child).exit_code == -1;
    if (!fs::exists(folder_ / "sums.exr")) continue;
    const Result<FilmFile> sums = read_film(folder_ / "sums.exr");
    ASSERT_TRUE(sums.has_value()) << sums.error().message;
    EXPECT_GE(sums->film.range().end, before);
    before = sums->film.range().end;
  }
  EXPECT_GE(killed, 2);  // else it proves nothing
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(content(folder_ / "out/resumed.exr"), whole);
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().string().find(".partial-"), std::string::npos) << entry.path();
  }
}

TEST_F(PathCommand, resuming_goes_on_and_refuses_other_pictures) {
  const auto resumed = [&](Words more) {
    more.insert(more.end(), {"--checkpoint", "sums.exr", "--resume", "-o", "out/b.exr"});
    return run(small(std::move(more)));
  };
  // Without a file it begins anew, with a note.
  const Outcome anew = resumed({"--samples", "4"});
  EXPECT_EQ(anew.exit_code, 0);
  EXPECT_NE(anew.complained.find("sums.exr does not exist yet"), std::string::npos) << anew.complained;
  const Outcome on = resumed({"--samples", "9", "--statistics", "out/b.json"});
  EXPECT_EQ(on.exit_code, 0) << on.complained;
  EXPECT_EQ(bytes("out/whole.exr", small({"--samples", "9"})), content(folder_ / "out/b.exr"));
  EXPECT_EQ(nlohmann::json::parse(content(folder_ / "out/b.json"))["samples_rendered"], 5);
  EXPECT_EQ(resumed({"--samples", "9"}).exit_code, 0);  // nothing left to do
  fs::remove_all(folder_ / "out"), fs::create_directories(folder_ / "out");
  const std::string sums = content(folder_ / "sums.exr");
  const auto refused = [&](Words more, const std::string& phrase) {
    const Outcome outcome = resumed(std::move(more));
    EXPECT_EQ(outcome.exit_code, 1) << phrase;
    EXPECT_NE(outcome.complained.find(phrase), std::string::npos) << outcome.complained;
    EXPECT_EQ(std::count(outcome.complained.begin(), outcome.complained.end(), '\n'), 1) << outcome.complained;
    EXPECT_EQ(files_in_out(), 0u);
    EXPECT_EQ(content(folder_ / "sums.exr"), sums);
  };
  refused({"--samples", "20", "--seed", "2"}, "its seed is '1', not '2'");
  refused({"--samples", "20", "--camera", "0,1,3/0,1,0"}, "camera");
  refused({"--samples", "20", "--exposure", "2"}, "exposure");
  refused({"--samples", "5"}, "samples 0:9");
  refused({"--sample-range", "3:20"}, "samples 0:9");
  write_text("sums.exr", "not a film");
  const Outcome foreign = resumed({"--samples", "20"});
  EXPECT_EQ(foreign.exit_code, 1);
  EXPECT_EQ(content(folder_ / "sums.exr"), "not a film");
}

TEST_F(PathCommand, a_resumed_part_is_the_part) {
  const std::string whole = bytes("whole.exr", small({"--sample-range", "4:9"}));
  const Words kept = {"--checkpoint", "sums.exr", "--resume"};
  Words first = small({"--sample-range", "4:6"}), second = small({"--sample-range", "4:9"});
  first.insert(first.end(), kept.begin(), kept.end()), second.insert(second.end(), kept.begin(), kept.end());
  bytes("first.exr", first);
  EXPECT_EQ(bytes("second.exr", second), whole);
}

TEST_F(PathCommand, misuse_is_refused_with_one_sentence_and_exit_code_2) {
  const auto with = [](Words more) {
    more.insert(more.end(), {"-o", "out/a.exr"});
    return small(std::move(more));
  };
  EXPECT_REFUSED(2, with({"--vpls", "64"}));
  EXPECT_REFUSED(2, with({"--delta", "0.1"}));
  EXPECT_REFUSED(2, with({"--jitter"}));
  EXPECT_REFUSED(2, with({"--accumulate", "4"}));
  EXPECT_REFUSED(2, with({"--frames", "1-2"}));
  EXPECT_REFUSED(2, with({"--lights", "all"}));
  EXPECT_REFUSED(2, with({"--layers", "direct"}));
  EXPECT_REFUSED(2, with({"--samples", "0"}));
  EXPECT_REFUSED(2, with({"--samples", "-1"}));
  EXPECT_REFUSED(2, with({"--samples", "99999999999"}));
  EXPECT_REFUSED(2, with({"--time", "0"}));
  EXPECT_REFUSED(2, with({"--time", "nan"}));
  EXPECT_REFUSED(2, with({"--noise", "-1"}));
  EXPECT_REFUSED(2, with({"--sample-range", "3"}));
  EXPECT_REFUSED(2, with({"--sample-range", "4:4"}));
  EXPECT_REFUSED(2, with({"--sample-range", "0:4", "--samples", "4"}));
  EXPECT_REFUSED(2, with({"--sample-range", "0:4", "--layers", "normal"}));
  EXPECT_REFUSED(2, with({"--resume"}));
  EXPECT_REFUSED(2, with({"--checkpoint", "sums.png"}));
  EXPECT_REFUSED(2, with({"--checkpoint", "out/../out/a.exr"}));
  EXPECT_REFUSED(2, with({"--checkpoint", "sums.exr", "--checkpoint-every", "0"}));
  EXPECT_REFUSED(2, with({"--display", "localhost"}));
  EXPECT_REFUSED(2, with({"--display", "localhost:0"}));
  EXPECT_REFUSED(2, small({"-o", "out/a.png", "--layers", "normal"}));
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "--method", "magic", "-o", "out/a.exr"});
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "--samples", "4", "-o", "out/a.exr"});
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "--bounces", "4", "-o", "out/a.exr"});
  EXPECT_REFUSED(2, {"merge", "-o", "out/a.exr"});
  EXPECT_REFUSED(2, {"merge", "a.exr", "-o", "out/a.gif"});
  const Outcome named = run(with({"--vpls", "64"}));
  EXPECT_NE(named.complained.find("--vpls belongs to --method frame"), std::string::npos) << named.complained;
}

TEST_F(PathCommand, bad_places_and_scenes_have_their_exit_codes) {
  EXPECT_REFUSED(1, small({"-o", "nowhere/a.exr"}));
  EXPECT_REFUSED(1, small({"-o", "out/a.exr", "--checkpoint", "nowhere/sums.exr"}));
  EXPECT_REFUSED(1, small({"-o", "out/a.exr", "--statistics", "nowhere/a.json"}));
  EXPECT_REFUSED(1, {"render", "nowhere.gltf", "--method", "path", "-o", "out/a.exr"});
  EXPECT_REFUSED(2, {"render", "recipe:cornell", "--method", "path", "--size", "16384x16384x2", "-o", "out/a.exr"});
  write_text("empty.gltf", R"({"asset":{"version":"2.0"}})");
  EXPECT_REFUSED(3, {"render", "empty.gltf", "--method", "path", "-o", "out/a.exr"});
}

TEST_F(PathCommand, every_size_is_rendered) {
  for (const char* size : {"1x1", "17x3", "1x40", "33x1"}) {
    bytes("out/a.exr", {"render", "recipe:cornell", "--method", "path", "--samples", "2", "--size", size});
    const Result<Image> picture = read_exr(folder_ / "out/a.exr");
    ASSERT_TRUE(picture.has_value());
    EXPECT_EQ(std::to_string(picture->width) + "x" + std::to_string(picture->height), size);
  }
}

TEST_F(PathCommand, shots_settings_serve_both_methods) {
  write_text("shot.toml",
             "scene = 'recipe:cornell'\n[settings]\nvpls = 64\nsize = [16, 9]\nexposure = 2.5\nerror_bound = 0.5\n"
             "range_samples = 'stratified'\nbounces = 1\n");
  bytes("out/a.exr", {"render", "shot.toml", "--method", "path", "--samples", "2"});
  const Result<Image> picture = read_exr(folder_ / "out/a.exr");
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->metadata.at("luciole.size"), "16x9");
  EXPECT_EQ(picture->metadata.at("luciole.exposure"), "2.5");
  EXPECT_EQ(picture->metadata.at("luciole.bounces"), "1");
  EXPECT_NE(picture->metadata.at("luciole.error_bound"), "0.5");  // that was said of the frame
  EXPECT_EQ(picture->metadata.at("luciole.range_samples"), "independent");
  EXPECT_FALSE(picture->metadata.contains("luciole.vpls"));
  bytes("out/b.exr", {"render", "shot.toml"});
  EXPECT_EQ(read_exr(folder_ / "out/b.exr")->metadata.at("luciole.range_samples"), "stratified");
  for (const char* fault : {"vplz = 3", "vpls = 'many'", "bounces = 0"}) {
    write_text("bad.toml", "scene = 'recipe:cornell'\n[settings]\n" + std::string(fault) + "\n");
    for (const char* method : {"frame", "path"}) {
      const Outcome outcome = run({"render", "bad.toml", "--method", method, "-o", "bad.exr"});
      EXPECT_EQ(outcome.exit_code, 3) << method << " " << fault << outcome.complained;
    }
  }
}

TEST_F(PathCommand, primary_lights_of_the_shot_shine) {
  write_text("without.toml", "scene = 'recipe:cornell'\n[settings]\nsize = [16, 16]\n");
  write_text("with.toml",
             "scene = 'recipe:cornell'\n[[primary]]\nkind = 'point'\nposition = [0.0, 1.0, 0.0]\n"
             "intensity = [100, 100, 100]\n[settings]\nsize = [16, 16]\n");
  bytes("out/without.exr", {"render", "without.toml", "--method", "path", "--samples", "8"});
  bytes("out/with.exr", {"render", "with.toml", "--method", "path", "--samples", "8"});
  const Outcome compared = run({"compare", "out/with.exr", "out/without.exr", "--json"});
  EXPECT_GT(nlohmann::json::parse(compared.said)["mean_ratio"].get<double>(), 2);
}

TEST_F(PathCommand, time_and_noise_stop_it) {
  const auto statistics = [&](Words more) {
    more.insert(more.end(), {"--statistics", "out/a.json", "-o", "out/a.exr"});
    EXPECT_EQ(run(small(std::move(more))).exit_code, 0);
    return nlohmann::json::parse(content(folder_ / "out/a.json"));
  };
  const auto timed = statistics({"--time", "0.5"});
  EXPECT_GT(timed["samples_per_pixel"], 1);
  EXPECT_LT(timed["render_seconds"].get<double>(), 3);
  EXPECT_EQ(statistics({"--time", "1e-9"})["samples_per_pixel"], 1);
  const auto quiet = statistics({"--noise", "0.2", "--time", "60"});
  EXPECT_LE(quiet["error_estimate"].get<double>(), 0.2);
  EXPECT_GE(quiet["samples_per_pixel"], 16);
  EXPECT_EQ(statistics({"--noise", "1e-9", "--samples", "20"})["samples_per_pixel"], 20);
  EXPECT_EQ(statistics({})["samples_per_pixel"], 64);
}

TEST_F(PathCommand, a_display_without_viewer_changes_nothing) {
  const std::string plain = bytes("out/a.exr", small({"--samples", "4"}));
  EXPECT_EQ(bytes("out/b.exr", small({"--samples", "4", "--display", "127.0.0.1:1"})), plain);
}

}  // namespace
}  // namespace luciole
