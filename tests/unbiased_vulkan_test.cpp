// SPDX-License-Identifier: Apache-2.0
// The mean over random ranges is the sum over all lights on the Vulkan engine, too; and what the test must reject.
#include "tests/unbiased_fixture.h"

namespace luciole::test {
namespace {

constexpr std::uint32_t kFewFrames = 128;  // of software Vulkan, which takes a hundred times as long as the CPU
constexpr std::uint32_t kFramesThatReject = 32;

struct Way {
  std::uint32_t interleave;
  Front front;  // cpu: the view is sent; rays: the device makes it
};

// The CPU's prediction for what `way` renders, of the same pixels and lights.
Settings to_render(Way way) {
  Settings settings = test_settings(way.interleave);
  settings.engine = Engine::vulkan, settings.front = way.front;
  return settings;
}
Settings to_expect(Way way) { return way.front == Front::cpu ? test_settings(way.interleave) : to_render(way); }

class UnbiasedOnTheDevice : public testing::TestWithParam<std::tuple<const char*, Way>> {};

TEST_P(UnbiasedOnTheDevice, mean_over_random_ranges_is_the_sum_over_all_lights) {
  const auto& [address, way] = GetParam();
  const ZTestReport report = test_frames(stage(address), to_expect(way), to_render(way), nullptr, kFewFrames);
  EXPECT_TRUE(report.passed) << address << ": " << report.reason;
}

INSTANTIATE_TEST_SUITE_P(Scenes, UnbiasedOnTheDevice,
                         testing::Combine(testing::Values("recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1"),
                                          testing::Values(Way{1, Front::cpu}, Way{8, Front::cpu},
                                                          Way{8, Front::rays})));

// Every light everywhere, without roulette or interleaving: what the device adds up is what the CPU does.
TEST(ReferenceOnTheDevice, is_the_mean_that_is_expected) {
  const Stage scene = stage("recipe:cornell?glossy=0.1");
  Settings settings = test_settings(1);
  const std::vector<Vec3> expected = expectation_of(scene, settings, 1).expectation().mean;
  settings.engine = Engine::vulkan, settings.culling = Culling::none, settings.ranges = Ranges::infinite;
  const Result<Frame> frame = renderer_of(scene, settings).render(0, {"unfiltered"});
  ASSERT_TRUE(frame.has_value());
  const std::vector<Vec3> found = frame->layers.colours("unfiltered");
  double difference = 0, light = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    difference += std::abs(channel_mean(found[i]) - channel_mean(expected[i]));
    light += channel_mean(expected[i]);
  }
  // A float sum of 4,096 lights is off by the root of so many roundings of half a unit, at most.
  EXPECT_LT(difference / light, std::sqrt(2.0 * 4096) * 6e-8);
}

TEST(UnbiasedOnTheDevice, clamped_ranges_are_rejected) {
  for (const Front front : {Front::cpu, Front::rays}) {
    Settings clamped = to_render({8, front});
    clamped.ranges = Ranges::clamped;
    EXPECT_FALSE(
        test_frames(stage("recipe:cornell?glossy=0.1"), to_expect({8, front}), clamped, nullptr, kFramesThatReject)
            .passed);
  }
}

}  // namespace
}  // namespace luciole::test
