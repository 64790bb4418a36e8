// SPDX-License-Identifier: Apache-2.0
#include "gpu/instance.h"

#include <algorithm>
#include <array>

#include "gpu/vulkan_answer.h"

namespace luciole::gpu {
namespace {

// Beside the core. The last two look at what kernels do.
constexpr std::array kChecks = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
                                VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT,
                                VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT};
constexpr std::size_t kChecksOfCalls = 1;
constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

}  // namespace

VKAPI_ATTR VkBool32 VKAPI_CALL Instance::hear(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* said, void* instance) {
  auto& self = *static_cast<Instance*>(instance);
  const std::scoped_lock lock(self.listening_);
  self.messages_.emplace_back(said->pMessage);
  return VK_FALSE;  // the call goes on: the run fails at its end, with the message
}

VkDebugUtilsMessengerCreateInfoEXT Instance::messenger_to_this() {
  auto how = of_type<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  how.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  how.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  how.pfnUserCallback = &Instance::hear;
  how.pUserData = this;
  return how;
}

Result<std::unique_ptr<Instance>> Instance::create(bool validation, bool in_kernels) {
  std::unique_ptr<Instance> instance(new Instance);
  auto application = of_type<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "luciole";
  application.apiVersion = VK_API_VERSION_1_3;
  auto wanted = of_type<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  wanted.pApplicationInfo = &application;
  auto checks = of_type<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  checks.enabledValidationFeatureCount = static_cast<std::uint32_t>(in_kernels ? kChecks.size() : kChecksOfCalls);
  checks.pEnabledValidationFeatures = kChecks.data();
  const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  if (validation) {
    wanted.pNext = &checks;
    wanted.enabledLayerCount = wanted.enabledExtensionCount = 1;
    wanted.ppEnabledLayerNames = &kLayer;
    wanted.ppEnabledExtensionNames = &extension;
  }
  if (Status made = checked(vkCreateInstance(&wanted, nullptr, &instance->handle_), "start Vulkan"); !made) {
    return made.error();
  }
  if (validation) {
    if (Status heard = instance->listen(instance->messenger_to_this()); !heard) return heard.error();
  }
  return instance;
}

Status Instance::listen(const VkDebugUtilsMessengerCreateInfoEXT& how) {
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(handle_, "vkCreateDebugUtilsMessengerEXT"));
  if (create == nullptr) return error_of(VK_ERROR_EXTENSION_NOT_PRESENT, "listen to the validation layers");
  return checked(create(handle_, &how, nullptr, &messenger_), "listen to the validation layers");
}

std::vector<std::string> Instance::messages() const {
  const std::scoped_lock lock(listening_);
  return messages_;
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(handle_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(handle_, messenger_, nullptr);
  }
  if (handle_ != VK_NULL_HANDLE) vkDestroyInstance(handle_, nullptr);
}

}  // namespace luciole::gpu
