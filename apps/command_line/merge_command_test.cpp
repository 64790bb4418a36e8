// SPDX-License-Identifier: Apache-2.0
// luciole merge, run as a user does.
#include "apps/command_line/path_command_fixture.h"

namespace luciole {
namespace {

TEST_F(PathCommand, merged_parts_are_the_file_that_one_run_writes) {
  for (const char* range : {"0:3", "3:4", "4:11", "11:12"}) {
    bytes("part-" + std::string(range) + ".exr", small({"--sample-range", range}));
  }
  const Words layers = {"--layers", "normal,variance"};
  const auto merged = [&](const std::string& output, Words words) {
    words.insert(words.begin(), "merge");
    return bytes(output, std::move(words));
  };
  const std::string whole = bytes("out/whole.exr", small({"--samples", "12", layers[0], layers[1]}));
  const std::string picture = bytes("out/whole.png", small({"--samples", "12"}));
  const std::string a = "part-0:3.exr", b = "part-3:4.exr", c = "part-4:11.exr", d = "part-11:12.exr";
  EXPECT_EQ(merged("out/m1.exr", {a, b, c, d, layers[0], layers[1]}), whole);
  EXPECT_EQ(merged("out/m2.exr", {d, b, a, c, layers[0], layers[1]}), whole);
  EXPECT_EQ(merged("out/m3.png", {c, d, a, b}), picture);
  // Merged parts are parts.
  merged("late.exr", {"--part", d, c});
  merged("early.exr", {"--part", b, a});
  EXPECT_EQ(merged("out/m4.exr", {"late.exr", "early.exr", layers[0], layers[1]}), whole);
  // The control: fewer samples give another file.
  EXPECT_NE(merged("out/m5.exr", {a, b, c, layers[0], layers[1]}), whole);
}

TEST_F(PathCommand, merging_refuses_what_does_not_belong_together_and_says_what) {
  const auto part = [&](const std::string& name, const std::string& range, Words more) {
    more.insert(more.end(), {"--sample-range", range});
    bytes(name, small(std::move(more)));
  };
  part("a.exr", "0:2", {});
  part("b.exr", "2:4", {});
  part("gap.exr", "5:6", {});
  part("overlap.exr", "1:4", {});
  part("seed.exr", "2:4", {"--seed", "2"});
  part("camera.exr", "2:4", {"--camera", "0,1,3/0,1,0"});
  part("length.exr", "2:4", {"--list-length", "3"});
  part("isa.exr", "2:4", {"--isa", "baseline"});
  part("bound.exr", "2:4", {"--error-bound", "0.5"});
  bytes("glossy.exr", {"render", "recipe:cornell?glossy=0.1", "--method", "path", "--size", "17x9", "--bounces", "2",
                       "--sample-range", "2:4"});
  bytes("size.exr",
        {"render", "recipe:cornell", "--method", "path", "--size", "9x17", "--bounces", "2", "--sample-range", "2:4"});
  bytes("picture.exr", small({"--samples", "2"}));
  const auto refused = [&](Words parts, const std::string& phrase) {
    parts.insert(parts.begin(), "merge");
    parts.insert(parts.end(), {"-o", "out/m.exr"});
    const Outcome outcome = run(parts);
    EXPECT_EQ(outcome.exit_code, 1) << phrase;
    EXPECT_NE(outcome.complained.find(phrase), std::string::npos) << outcome.complained;
    EXPECT_NE(outcome.complained.find(parts[parts.size() - 3]), std::string::npos) << outcome.complained;
    EXPECT_EQ(std::count(outcome.complained.begin(), outcome.complained.end(), '\n'), 1) << outcome.complained;
    EXPECT_EQ(files_in_out(), 0u);
  };
  refused({"a.exr", "gap.exr"}, "samples 2:5 are missing");
  refused({"b.exr"}, "samples 0:2 are missing");
  refused({"a.exr", "overlap.exr"}, "samples");
  refused({"a.exr", "a.exr"}, "samples");
  refused({"a.exr", "seed.exr"}, "seed is '2', not '1'");
  refused({"a.exr", "camera.exr"}, "camera");
  refused({"a.exr", "length.exr"}, "list_length is '3', not '8'");
  refused({"a.exr", "bound.exr"}, "error_bound");
  refused({"a.exr", "glossy.exr"}, "shot");
  refused({"a.exr", "size.exr"}, "size is '9x17', not '17x9'");
  refused({"a.exr", "picture.exr"}, "without the sums");
  refused({"a.exr", "nowhere.exr"}, "no such file");
  if (content(folder_ / "isa.exr") != content(folder_ / "b.exr")) refused({"a.exr", "isa.exr"}, "isa is 'baseline'");
}

TEST_F(PathCommand, a_part_of_a_changed_scene_is_refused) {
  write_text("shot.toml", "scene = 'recipe:cornell'\n");
  const Words words = {"render", "shot.toml", "--method", "path", "--size", "8x8", "--sample-range"};
  Words first = words, second = words;
  first.push_back("0:2"), second.push_back("2:4");
  bytes("a.exr", first);
  write_text("shot.toml", "scene = 'recipe:cornell'\n[materials]\nmetallic = 1\n");  // of the same name
  bytes("b.exr", second);
  const Outcome outcome = run({"merge", "a.exr", "b.exr", "-o", "out/m.exr"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.complained.find("its scene is another one"), std::string::npos) << outcome.complained;
}

}  // namespace
}  // namespace luciole
