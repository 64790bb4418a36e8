// SPDX-License-Identifier: Apache-2.0
// Which device is taken, and where memory is found: without a device.
#include "gpu/device_list.h"

#include <gtest/gtest.h>

#include "gpu/free_list.h"

namespace luciole::gpu {
namespace {

DeviceDescription device(const char* name, DeviceKind kind, std::vector<std::string> missing = {}) {
  DeviceDescription d;
  d.name = name, d.kind = kind, d.missing = std::move(missing);
  return d;
}

const std::vector<DeviceDescription> kDevices = {
    device("Soft Pipe", DeviceKind::cpu), device("Old Card 1", DeviceKind::discrete, {"Vulkan 1.3"}),
    device("Board Chip", DeviceKind::integrated), device("Big Card 2", DeviceKind::discrete)};

TEST(ChooseDevice, prefers_discrete_then_integrated_then_software_among_those_that_lack_nothing) {
  EXPECT_EQ(*choose_device(kDevices, ""), 3u);
  EXPECT_EQ(*choose_device({kDevices[0], kDevices[1], kDevices[2]}, ""), 2u);
  EXPECT_EQ(*choose_device({kDevices[0], kDevices[1]}, ""), 0u);
}

TEST(ChooseDevice, of_hardware_only_takes_no_software) {
  EXPECT_EQ(*choose_device(kDevices, "", true), 3u);
  EXPECT_FALSE(choose_device({kDevices[0], kDevices[1]}, "", true).has_value());
  EXPECT_FALSE(choose_device(kDevices, "soft", true).has_value());
}

TEST(ChooseDevice, takes_the_one_that_is_named) {
  EXPECT_EQ(*choose_device(kDevices, "0"), 0u);
  EXPECT_EQ(*choose_device(kDevices, "board"), 2u);
}

TEST(ChooseDevice, says_what_is_wrong_in_one_sentence) {
  EXPECT_EQ(choose_device({}, "").error().message, "there is no Vulkan device on this machine");
  EXPECT_EQ(choose_device(kDevices, "old").error().message, "the Vulkan device 'Old Card 1' lacks Vulkan 1.3");
  const Error unknown = choose_device(kDevices, "7").error();
  EXPECT_EQ(unknown.kind, ErrorKind::usage);
  EXPECT_EQ(unknown.message,
            "there is no Vulkan device '7'; there is 0 'Soft Pipe', 1 'Old Card 1', 2 'Board Chip', 3 'Big Card 2'");
}

TEST(FreeList, gives_aligned_pieces_that_do_not_overlap_and_merges_what_comes_back) {
  FreeList list(1000);
  const auto a = list.take(100, 1), b = list.take(10, 64), c = list.take(500, 256);
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(*a, 0u);
  EXPECT_EQ(*b, 128u);
  EXPECT_EQ(*c, 256u);
  EXPECT_EQ(*list.take(28, 4), 100u);  // the gap that the alignment left
  EXPECT_FALSE(list.take(300, 1).has_value());
  list.give_back(256, 500);
  EXPECT_EQ(*list.take(862, 1), 138u);  // only if that piece merged with what lies behind it, and before
  list.give_back(138, 862), list.give_back(100, 28), list.give_back(128, 10);
  EXPECT_FALSE(list.unused());
  list.give_back(0, 100);
  EXPECT_TRUE(list.unused());
}

}  // namespace
}  // namespace luciole::gpu
