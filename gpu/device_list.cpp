// SPDX-License-Identifier: Apache-2.0
#include "gpu/device_list.h"

#include <algorithm>
#include <cctype>

#include "base/setting_table.h"
#include "base/text.h"
#include "gpu/vulkan_answer.h"

namespace luciole::gpu {
namespace {

DeviceKind kind_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return DeviceKind::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return DeviceKind::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return DeviceKind::virtual_machine;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return DeviceKind::cpu;
    default:
      return DeviceKind::other;
  }
}

std::uint64_t largest_own_heap(VkPhysicalDevice device) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  std::uint64_t largest = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      largest = std::max<std::uint64_t>(largest, memory.memoryHeaps[i].size);
  }
  return largest;
}

void note_features(VkPhysicalDevice device, DeviceDescription& description) {
  auto in_1_3 = of_type<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  auto in_1_2 = of_type<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  auto features = of_type<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  features.pNext = &in_1_2;
  in_1_2.pNext = &in_1_3;
  vkGetPhysicalDeviceFeatures2(device, &features);
  const auto need = [&](VkBool32 there, const char* name) {
    if (!there) description.missing.emplace_back(name);
  };
  need(features.features.shaderInt64, "shaderInt64");
  need(in_1_2.bufferDeviceAddress, "bufferDeviceAddress");
  need(in_1_2.scalarBlockLayout, "scalarBlockLayout");
  need(in_1_3.computeFullSubgroups, "computeFullSubgroups");
  need(in_1_3.synchronization2, "synchronization2");
  need(in_1_3.maintenance4, "maintenance4");
  description.half_floats = in_1_2.shaderFloat16 == VK_TRUE;
}

void note_missing_abilities(VkPhysicalDevice device, const VkPhysicalDeviceSubgroupProperties& subgroups,
                            const VkPhysicalDeviceLimits& limits, std::vector<std::string>& missing) {
  constexpr VkSubgroupFeatureFlags kOperations =
      VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
  if ((subgroups.supportedOperations & kOperations) != kOperations ||
      !(subgroups.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT)) {
    missing.emplace_back("subgroup ballot and arithmetic in compute shaders");
  }
  constexpr std::uint32_t kInvocations = 256, kSharedBytes = 32768;
  if (limits.maxComputeWorkGroupInvocations < kInvocations || limits.maxComputeWorkGroupSize[0] < kInvocations) {
    missing.emplace_back("workgroups of 256 invocations");
  }
  if (limits.maxComputeSharedMemorySize < kSharedBytes) missing.emplace_back("32 KiB of shared memory");
  if (choose_queue_family(device) == ~0u) missing.emplace_back("a compute queue with timestamps");
}

std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice device) {
  return listed<VkQueueFamilyProperties>([&](std::uint32_t* count, VkQueueFamilyProperties* to) {
    vkGetPhysicalDeviceQueueFamilyProperties(device, count, to);
  });
}

// What a device may lack and still be of use: then rays are cast instead.
bool can_rasterise(VkPhysicalDevice device) {
  const std::uint32_t family = choose_queue_family(device);
  if (family == ~0u || !(queue_families(device)[family].queueFlags & VK_QUEUE_GRAPHICS_BIT)) return false;
  auto in_1_3 = of_type<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  auto features = of_type<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  features.pNext = &in_1_3;
  vkGetPhysicalDeviceFeatures2(device, &features);
  VkFormatProperties depth;
  vkGetPhysicalDeviceFormatProperties(device, VK_FORMAT_D32_SFLOAT, &depth);
  return in_1_3.dynamicRendering && features.features.multiDrawIndirect &&
         features.features.drawIndirectFirstInstance &&
         (depth.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
}

DeviceDescription describe(VkPhysicalDevice device) {
  auto subgroups = of_type<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
  auto driver = of_type<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
  auto properties = of_type<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  properties.pNext = &subgroups;
  subgroups.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device, &properties);
  DeviceDescription d;
  d.name = properties.properties.deviceName;
  d.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  d.kind = kind_of(properties.properties.deviceType);
  d.subgroup_size = subgroups.subgroupSize;
  d.shuffles = (subgroups.supportedOperations & VK_SUBGROUP_FEATURE_SHUFFLE_BIT) != 0;
  d.memory_bytes = largest_own_heap(device);
  if (properties.properties.apiVersion < VK_API_VERSION_1_3) {
    d.missing.emplace_back("Vulkan 1.3");
    return d;  // it may not be asked for what 1.3 brought
  }
  note_features(device, d);
  note_missing_abilities(device, subgroups, properties.properties.limits, d.missing);
  d.rasterises = can_rasterise(device);
  return d;
}

std::string lower_case(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

std::string all_of_them(const std::vector<DeviceDescription>& devices) {
  std::vector<std::string> list;
  for (const DeviceDescription& device : devices)
    list.push_back(std::to_string(list.size()) + " '" + device.name + "'");
  return joined(list);
}

Result<std::size_t> usable(const std::vector<DeviceDescription>& devices, std::size_t index) {
  if (devices[index].missing.empty()) return index;
  return Error{ErrorKind::failed,
               "the Vulkan device '" + devices[index].name + "' lacks " + joined(devices[index].missing)};
}

Result<std::size_t> device_named(const std::vector<DeviceDescription>& devices, const std::string& wanted) {
  std::size_t index = 0;
  if (parse_number(wanted, index) && index < devices.size()) return usable(devices, index);
  for (index = 0; index < devices.size(); ++index) {
    if (lower_case(devices[index].name).find(lower_case(wanted)) != std::string::npos) return usable(devices, index);
  }
  return Error{ErrorKind::usage, "there is no Vulkan device '" + wanted + "'; there is " + all_of_them(devices)};
}

}  // namespace

std::vector<VkPhysicalDevice> physical_devices(const Instance& instance) {
  return listed<VkPhysicalDevice>(
      [&](std::uint32_t* count, VkPhysicalDevice* to) { vkEnumeratePhysicalDevices(instance.handle(), count, to); });
}

std::uint32_t choose_queue_family(VkPhysicalDevice device) {
  const std::vector<VkQueueFamilyProperties> families = queue_families(device);
  std::uint32_t chosen = ~0u;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) || families[i].timestampValidBits == 0) continue;
    if (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) return i;
    if (chosen == ~0u) chosen = i;
  }
  return chosen;
}

std::vector<DeviceDescription> list_devices(const Instance& instance) {
  std::vector<DeviceDescription> descriptions;
  for (VkPhysicalDevice device : physical_devices(instance)) descriptions.push_back(describe(device));
  return descriptions;
}

Result<std::size_t> choose_device(const std::vector<DeviceDescription>& devices, const std::string& wanted,
                                  bool hardware_only) {
  if (devices.empty()) return Error{ErrorKind::failed, "there is no Vulkan device on this machine"};
  if (!wanted.empty()) {
    const Result<std::size_t> named = device_named(devices, wanted);
    if (!named || !hardware_only || devices[*named].kind != DeviceKind::cpu) return named;
    return Error{ErrorKind::failed, "the Vulkan device '" + devices[*named].name + "' is software on the CPU"};
  }
  std::size_t best = devices.size();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceDescription& device = devices[i];
    if (!device.missing.empty() || (hardware_only && device.kind == DeviceKind::cpu)) continue;
    if (best == devices.size() || device.kind < devices[best].kind) best = i;
  }
  if (best < devices.size()) return best;
  if (hardware_only) return Error{ErrorKind::failed, "there is no Vulkan device in hardware that will do"};
  return usable(devices, 0).error();
}

}  // namespace luciole::gpu
