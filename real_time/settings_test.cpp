// SPDX-License-Identifier: Apache-2.0
#include "real_time/settings.h"

#include <gtest/gtest.h>

#include <numbers>

#include "real_time/settings_text.h"

namespace luciole {
namespace {

TEST(Settings, survive_the_way_through_text) {
  Settings settings;
  settings.width = 640, settings.height = 360;
  settings.bounds = BoundingVolume::sphere_at_light;
  settings.ranges = Ranges::clamped_bound;
  settings.delta = 0.0012345678f;
  settings.stratified_ranges = true;
  settings.jitter = true;
  settings.engine = Engine::vulkan;
  settings.seed = 18446744073709551615u;
  const Result<Settings> read = settings_from(settings_as_text(settings), {});
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(settings_as_text(*read), settings_as_text(settings));
  EXPECT_EQ(read->delta, settings.delta);
  EXPECT_NE(settings_as_text(*read), settings_as_text(Settings{}));
}

TEST(Settings, the_command_line_wins_over_the_shot) {
  const Result<Settings> read = settings_from({{"vpls", "100"}, {"delta", "0.5"}}, {{"vpls", "200"}});
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->vpls, 200u);
  EXPECT_EQ(read->delta, 0.5f);
}

TEST(Settings, error_bound_is_delta_over_two_pi) {
  const Result<Settings> read = settings_from({{"delta", "0.5"}}, {{"error_bound", "0.25"}});
  ASSERT_TRUE(read.has_value());
  EXPECT_FLOAT_EQ(read->delta, 0.5f * std::numbers::pi_v<float>);
  EXPECT_FALSE(settings_from({}, {{"error_bound", "0.25"}, {"delta", "0.5"}}).has_value());
}

TEST(Settings, the_tile_test_follows_the_bounds_until_it_is_named) {
  EXPECT_EQ(settings_from({}, {})->tile_test, TileTest::tight);
  EXPECT_EQ(settings_from({}, {{"bounds", "sphere"}})->tile_test, TileTest::paper);
  EXPECT_EQ(settings_from({{"tile_test", "exact"}}, {{"bounds", "sphere"}})->tile_test, TileTest::exact);
}

TEST(Settings, bad_values_are_refused_and_change_nothing) {
  const SettingText bad[] = {{"size", "0x10"},       {"size", "64"},     {"size", "16385x1"},    {"size", "-4x4"},
                             {"vpls", "0"},          {"vpls", "1e3"},    {"vpls", "4294967296"}, {"bounds", "cube"},
                             {"interleave", "3"},    {"delta", "0"},     {"delta", "nan"},       {"delta", "1,5"},
                             {"error_bound", "inf"}, {"exposure", "-1"}, {"jitter", "yes"},      {"seed", "-1"},
                             {"isa", "sse9"},        {"engine", "gpu"},  {"device", ""},         {"range_samples", ""},
                             {"warp", "9"}};
  for (const auto& [name, text] : bad) {
    Settings settings;
    const Status status = set_setting(settings, name, text);
    ASSERT_FALSE(status.has_value()) << name << " " << text;
    EXPECT_EQ(status.error().kind, ErrorKind::usage);
    EXPECT_NE(status.error().message.find(name), std::string::npos) << status.error().message;
    EXPECT_EQ(settings_as_text(settings), settings_as_text(Settings{})) << name << " " << text;
  }
}

TEST(Settings, every_name_has_a_help_line) {
  for (const std::string& name : setting_names()) EXPECT_FALSE(setting_help(name).empty()) << name;
  EXPECT_TRUE(setting_help("warp").empty());
}

TEST(ChooseIsa, never_chooses_what_the_processor_lacks) {
  const Result<Isa> best = choose_isa(Isa::automatic);
  ASSERT_TRUE(best.has_value());
  EXPECT_NE(*best, Isa::automatic);
  EXPECT_TRUE(choose_isa(*best).has_value());
  ASSERT_TRUE(choose_isa(Isa::baseline).has_value());
  EXPECT_EQ(*choose_isa(Isa::baseline), Isa::baseline);
#if defined(__x86_64__)
  EXPECT_EQ(choose_isa(Isa::avx512).has_value(), *best == Isa::avx512);
#endif
}

}  // namespace
}  // namespace luciole
