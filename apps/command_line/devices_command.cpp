// SPDX-License-Identifier: Apache-2.0
// luciole devices: what Vulkan has on this machine, and what render would take of it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/command_line/commands.h"
#include "base/name_table.h"
#include "base/text.h"
#include "gpu/device_list.h"

namespace luciole {
namespace {

std::string describe(std::size_t index, const gpu::DeviceDescription& device) {
  constexpr double kGib = 1024.0 * 1024 * 1024;
  return fmt::format(
      "{} {}\n    kind       {}\n    driver     {}\n    subgroups  of {} invocations\n    memory     {:.1f} GiB\n"
      "    views      {}\n    missing    {}\n",
      index, device.name, name_of(device.kind), device.driver, device.subgroup_size,
      static_cast<double>(device.memory_bytes) / kGib,
      device.rasterises ? "rasterised, or by rays" : "by rays alone: it cannot rasterise",
      device.missing.empty() ? "nothing" : joined(device.missing));
}

std::string taken(const std::vector<gpu::DeviceDescription>& devices, bool hardware_only, const char* otherwise) {
  const Result<std::size_t> chosen = gpu::choose_device(devices, "", hardware_only);
  return chosen ? fmt::format("{} {}", *chosen, devices[*chosen].name) : otherwise;
}

Result<int> run_devices() {
  const Result<std::unique_ptr<gpu::Instance>> vulkan = gpu::Instance::create(false);
  if (!vulkan) return vulkan.error();
  const std::vector<gpu::DeviceDescription> devices = gpu::list_devices(**vulkan);
  if (devices.empty()) std::puts("There is no Vulkan device on this machine.");
  for (std::size_t i = 0; i < devices.size(); ++i) std::fputs(describe(i, devices[i]).c_str(), stdout);
  fmt::print("--engine vulkan takes {}\n--engine auto takes {}\n", taken(devices, false, "none of them"),
             taken(devices, true, "the CPU engine"));
  return 0;
}

}  // namespace

void add_devices_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand("devices", "List the Vulkan devices and what each lacks");
  command->callback([&chosen] { chosen = run_devices; });
}

}  // namespace luciole
