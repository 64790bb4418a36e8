// SPDX-License-Identifier: Apache-2.0
#include "gpu/device.h"

#include "gpu/vulkan_answer.h"

namespace luciole::gpu {

Result<std::unique_ptr<Device>> Device::create(const DeviceRequest& request) {
  Result<std::unique_ptr<Instance>> instance = Instance::create(request.validation, request.in_kernels);
  if (!instance) return instance.error();
  const std::vector<DeviceDescription> devices = list_devices(**instance);
  const Result<std::size_t> chosen = choose_device(devices, request.wanted, request.hardware_only);
  if (!chosen) return chosen.error();
  std::unique_ptr<Device> device(new Device);
  device->description_ = devices[*chosen];
  device->description_.rasterises = device->description_.rasterises && request.may_rasterise;
  device->lost_from_submission_ = request.lost_from_submission;
  const VkPhysicalDevice physical = physical_devices(**instance)[*chosen];
  device->instance_ = std::move(*instance);
  if (Status opened = device->open(physical); !opened) return opened.error();
  return device;
}

Status Device::open(VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  limits_ = properties.limits;
  VkPhysicalDeviceFeatures offered;
  vkGetPhysicalDeviceFeatures(physical, &offered);
  queue_family_ = choose_queue_family(physical);
  const float priority = 1;
  auto queue = of_type<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  auto in_1_3 = of_type<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  const VkBool32 rasterises = description_.rasterises ? VK_TRUE : VK_FALSE;
  in_1_3.dynamicRendering = rasterises;
  in_1_3.computeFullSubgroups = in_1_3.synchronization2 = in_1_3.maintenance4 = VK_TRUE;
  auto in_1_2 = of_type<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  in_1_2.pNext = &in_1_3;
  in_1_2.bufferDeviceAddress = in_1_2.scalarBlockLayout = VK_TRUE;
  in_1_2.shaderFloat16 = description_.half_floats ? VK_TRUE : VK_FALSE;
  auto features = of_type<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  features.pNext = &in_1_2;
  features.features.shaderInt64 = VK_TRUE;
  features.features.multiDrawIndirect = features.features.drawIndirectFirstInstance = rasterises;
  if (instance_->validation()) {  // what GPU-assisted checks write their findings with
    features.features.fragmentStoresAndAtomics = offered.fragmentStoresAndAtomics;
    features.features.vertexPipelineStoresAndAtomics = offered.vertexPipelineStoresAndAtomics;
  }
  auto wanted = of_type<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  wanted.pNext = &features;
  wanted.queueCreateInfoCount = 1;
  wanted.pQueueCreateInfos = &queue;
  const std::string attempt = "open the Vulkan device '" + description_.name + "'";
  if (Status made = checked(vkCreateDevice(physical, &wanted, nullptr, &handle_), attempt); !made) return made;
  vkGetDeviceQueue(handle_, queue_family_, 0, &queue_);
  memory_ = std::make_unique<Memory>(physical, handle_);
  const auto fence = of_type<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  return checked(vkCreateFence(handle_, &fence, nullptr, &finished_), attempt);
}

Status Device::run(VkCommandBuffer commands) {
  const std::string attempt = "compute on the Vulkan device '" + description_.name + "'";
  ++submissions_;
  VkResult answer = VK_ERROR_DEVICE_LOST;
  if (!lost_ && (lost_from_submission_ == 0 || submissions_ < lost_from_submission_)) {
    auto work = of_type<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
    work.commandBuffer = commands;
    auto submission = of_type<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
    submission.commandBufferInfoCount = 1;
    submission.pCommandBufferInfos = &work;
    answer = vkQueueSubmit2(queue_, 1, &submission, finished_);
    if (answer == VK_SUCCESS) answer = vkWaitForFences(handle_, 1, &finished_, VK_TRUE, UINT64_MAX);
    if (answer == VK_SUCCESS) answer = vkResetFences(handle_, 1, &finished_);
  }
  lost_ = lost_ || answer == VK_ERROR_DEVICE_LOST;
  return checked(answer, attempt);
}

Status Device::validated() const {
  const std::vector<std::string> messages = instance_->messages();
  if (messages.empty()) return Done{};
  const std::string more = messages.size() > 1 ? " (and " + std::to_string(messages.size() - 1) + " more)" : "";
  return Error{ErrorKind::failed, "Vulkan validation: " + messages.front() + more};
}

Device::~Device() {
  if (handle_ == VK_NULL_HANDLE) return;
  vkDestroyFence(handle_, finished_, nullptr);
  memory_.reset();
  vkDestroyDevice(handle_, nullptr);
}

}  // namespace luciole::gpu
