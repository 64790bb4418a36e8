// SPDX-License-Identifier: Apache-2.0
// Which Vulkan devices there are, what each lacks for us, and which one is taken.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/name_table.h"
#include "base/result.h"
#include "gpu/instance.h"

namespace luciole::gpu {

// In the order of preference.
enum class DeviceKind : std::uint8_t { discrete, integrated, virtual_machine, other, cpu };

constexpr NameTable<DeviceKind, 5> names(DeviceKind) {
  return {{{DeviceKind::discrete, "discrete GPU"},
           {DeviceKind::integrated, "integrated GPU"},
           {DeviceKind::virtual_machine, "GPU of a virtual machine"},
           {DeviceKind::other, "other"},
           {DeviceKind::cpu, "software on the CPU"}}};
}

struct DeviceDescription {
  std::string name, driver;
  DeviceKind kind = DeviceKind::other;
  std::uint32_t subgroup_size = 0;
  std::uint64_t memory_bytes = 0;    // largest heap of its own
  std::vector<std::string> missing;  // what the engine needs and the device lacks
  bool rasterises = false;           // it can also draw, as RasterPipeline does
  bool half_floats = false;          // kernels may compute with floats of 16 bits
  bool shuffles = false;             // an invocation may read any other's value within its subgroup
};

// In the order in which Vulkan lists them: a device's place is its index.
std::vector<DeviceDescription> list_devices(const Instance& instance);

// Which device to take.
//   wanted         its index, or a part of its name in any case; empty: the first of the best kind that lacks nothing
//   hardware_only  none that is software on the CPU
Result<std::size_t> choose_device(const std::vector<DeviceDescription>& devices, const std::string& wanted,
                                  bool hardware_only = false);

// The physical devices themselves, in the same order.
std::vector<VkPhysicalDevice> physical_devices(const Instance& instance);

// Which of a device's queue families to use: one that computes and keeps time, and draws if one does all three. None:
// 0xffffffff.
std::uint32_t choose_queue_family(VkPhysicalDevice device);

}  // namespace luciole::gpu
