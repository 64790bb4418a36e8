// SPDX-License-Identifier: Apache-2.0
// luciole devices, and render on a Vulkan device, as a user runs them.
#include <nlohmann/json.hpp>

#include "apps/command_line/run_program.h"
#include "image/exr.h"

namespace luciole {
namespace {

class EngineCommand : public CommandLine {};

std::vector<std::string> render(std::vector<std::string> more) {
  std::vector<std::string> words = {"render", "recipe:cornell", "--size", "64x36", "--vpls", "256"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(EngineCommand, devices_tells_what_there_is_and_what_is_missing) {
  const Outcome outcome = run({"devices"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.complained;
  for (const char* word : {"0 ", "kind", "driver", "subgroups", "memory", "missing", "--engine auto takes"}) {
    EXPECT_NE(outcome.said.find(word), std::string::npos) << word << " in " << outcome.said;
  }
}

TEST_F(EngineCommand, vulkan_is_recorded_in_picture_and_statistics) {
  const Outcome outcome = run(render(
      {"--engine", "vulkan", "-o", "out/a.exr", "--layers", "indirect,lights_listed", "--statistics", "out/a.json"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.complained;
  const Result<Image> picture = read_exr(folder_ / "out/a.exr");
  ASSERT_TRUE(picture.has_value()) << picture.error().message;
  EXPECT_EQ(picture->metadata.at("luciole.engine"), "vulkan");
  EXPECT_FALSE(picture->metadata.at("luciole.device").empty());
  EXPECT_TRUE(picture->has_layer("indirect"));
  EXPECT_TRUE(picture->has_layer("lights_listed"));
  const auto statistics = nlohmann::json::parse(content(folder_ / "out/a.json"));
  EXPECT_EQ(statistics["engine"], "vulkan");
  EXPECT_EQ(statistics["settings"]["engine"], "vulkan");
  EXPECT_EQ(statistics["device"], picture->metadata.at("luciole.device"));
  EXPECT_TRUE(statistics["passes_ms"].contains("culling_and_shading"));
  EXPECT_GT(statistics["lights_accepted_per_pixel"]["total"].get<double>(), 0);
}

TEST_F(EngineCommand, cpu_is_the_engine_that_nobody_asks_for) {
  ASSERT_EQ(run(render({"-o", "out/a.exr", "--statistics", "out/a.json"})).exit_code, 0);
  EXPECT_EQ(read_exr(folder_ / "out/a.exr")->metadata.at("luciole.engine"), "cpu");
  const auto statistics = nlohmann::json::parse(content(folder_ / "out/a.json"));
  EXPECT_EQ(statistics["engine"], "cpu");
  EXPECT_FALSE(statistics.contains("device"));
}

// Pixels, lights and shadows are the device's, and so is their sum: nothing of the frame's light is the CPU's.
TEST_F(EngineCommand, vulkan_makes_the_whole_frame_if_asked) {
  for (const char* front : {"raster", "rays"}) {
    ASSERT_EQ(run(render({"-o", "out/a.exr", "-o", "out/a.png", "--engine", "vulkan", "--front", front, "--statistics",
                          "out/a.json"}))
                  .exit_code,
              0)
        << front;
    const auto statistics = nlohmann::json::parse(content(folder_ / "out/a.json"));
    for (const char* pass : {"geometry_buffer", "reflective_shadow_map", "direct_light", "composition"})
      EXPECT_GT(statistics["passes_ms"][pass].get<double>(), 0) << pass;
    EXPECT_GT(statistics["virtual_point_lights"].get<double>(), 0);
  }
}

TEST_F(EngineCommand, refuses_what_the_engine_cannot_do) {
  EXPECT_REFUSED(2, render({"-o", "out/a.exr", "--engine", "vulkan", "--device", "no such device"}));
  EXPECT_REFUSED(2, render({"-o", "out/a.exr", "--device", "0"}));
  EXPECT_REFUSED(2, render({"-o", "out/a.exr", "--vulkan-validation"}));
  EXPECT_REFUSED(2, render({"-o", "out/a.exr", "--front", "rays"}));
  EXPECT_REFUSED(2, render({"-o", "out/a.exr", "--engine", "vulkan", "--front", "mirror"}));
  EXPECT_REFUSED(2, render({"-o", "out/a.exr", "--engine", "quantum"}));
  EXPECT_REFUSED(2, render({"-o", "out/a.exr", "--method", "path", "--engine", "vulkan"}));
}

}  // namespace
}  // namespace luciole
