// SPDX-License-Identifier: Apache-2.0
#include "gpu/vulkan_answer.h"

namespace luciole::gpu {
namespace {

std::string reason(VkResult answer) {
  switch (answer) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "this machine's memory is used up";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "the device's memory is used up; a smaller --size or fewer --vpls help";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no Vulkan driver is installed";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "the validation layers are not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "an extension is missing";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "a feature is missing";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "the driver failed to start";
    default:
      return "Vulkan answered " + std::to_string(static_cast<int>(answer));
  }
}

}  // namespace

Error error_of(VkResult answer, const std::string& attempt) {
  const bool memory = answer == VK_ERROR_OUT_OF_HOST_MEMORY || answer == VK_ERROR_OUT_OF_DEVICE_MEMORY;
  return {memory ? ErrorKind::out_of_memory : ErrorKind::failed, "cannot " + attempt + ": " + reason(answer)};
}

}  // namespace luciole::gpu
