// SPDX-License-Identifier: Apache-2.0
// The door to Vulkan: its loader and drivers, and what the validation layers say if they are asked.
#pragma once
#include <vulkan/vulkan.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/result.h"

namespace luciole::gpu {

class Instance {
 public:
  // validation  with the Khronos layers: core, synchronisation and GPU-assisted checks; slow
  // in_kernels  with the GPU-assisted ones: each access of a kernel is checked, and large ones take minutes to compile
  static Result<std::unique_ptr<Instance>> create(bool validation, bool in_kernels = true);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return handle_; }
  bool validation() const { return messenger_ != VK_NULL_HANDLE; }
  std::vector<std::string> messages() const;  // warnings and errors of the layers so far

 private:
  Instance() = default;
  Status listen(const VkDebugUtilsMessengerCreateInfoEXT& how);
  VkDebugUtilsMessengerCreateInfoEXT messenger_to_this();
  static VKAPI_ATTR VkBool32 VKAPI_CALL hear(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                             VkDebugUtilsMessageTypeFlagsEXT types,
                                             const VkDebugUtilsMessengerCallbackDataEXT* said, void* instance);

  VkInstance handle_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  mutable std::mutex listening_;
  std::vector<std::string> messages_;
};

}  // namespace luciole::gpu
