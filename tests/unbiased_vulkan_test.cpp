// SPDX-License-Identifier: Apache-2.0
// The mean over random ranges is the sum over all lights on the Vulkan engine, too; and what the test must reject.
#include "tests/unbiased_fixture.h"

namespace luciole::test {
namespace {

// Interleaved frames have the view that the device made; the others one that was sent.
class UnbiasedOnTheDevice : public testing::TestWithParam<std::tuple<const char*, std::uint32_t>> {};

TEST_P(UnbiasedOnTheDevice, mean_over_random_ranges_is_the_sum_over_all_lights) {
  const auto& [address, interleave] = GetParam();
  Settings expected = test_settings(interleave);
  Settings rendered = expected;
  rendered.engine = Engine::vulkan, rendered.front = Front::cpu;
  if (interleave > 1) {
    rendered.front = Front::rays;
    expected = rendered;  // the CPU's prediction, of the same pixels and lights
  }
  const ZTestReport report = test_frames(stage(address), expected, rendered);
  EXPECT_TRUE(report.passed) << address << ": " << report.reason;
}

INSTANTIATE_TEST_SUITE_P(Scenes, UnbiasedOnTheDevice,
                         testing::Combine(testing::Values("recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1"),
                                          testing::Values(1u, 8u)));

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
  const Settings settings = test_settings(8);
  Settings clamped = settings;
  clamped.ranges = Ranges::clamped, clamped.engine = Engine::vulkan;
  EXPECT_FALSE(test_frames(stage("recipe:cornell?glossy=0.1"), settings, clamped).passed);
}

}  // namespace
}  // namespace luciole::test
