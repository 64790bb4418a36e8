// SPDX-License-Identifier: Apache-2.0
// Just enough Vulkan to run a compute shader: no window, buffers that the CPU can see. Whatever fails ends the program
// with one sentence.
#pragma once
#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// The push constants of every shader here.
struct FrameConstants {
  std::uint32_t width, height, light_count, frame;
};

class Device {
 public:
  Device();
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  const std::string& name() const { return name_; }
  VkDevice handle() const { return device_; }

  // Runs one command list and waits for it.
  template <class Record>
  void run(Record record) {
    begin();
    record(commands_);
    submit_and_wait();
  }
  std::uint32_t host_visible_memory(std::uint32_t allowed_types) const;

 private:
  void begin();
  void submit_and_wait();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  std::string name_;
};

// A storage buffer, mapped for as long as it lives.
class Buffer {
 public:
  Buffer(const Device& device, std::size_t bytes);
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  VkBuffer handle() const { return buffer_; }
  template <class T>
  T* as() const {
    return static_cast<T*>(mapped_);
  }

 private:
  VkDevice device_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  void* mapped_ = nullptr;
};

// A compute shader with its storage buffers at bindings 0, 1, ..
class Kernel {
 public:
  Kernel(Device& device, const std::vector<std::uint32_t>& spirv, const std::vector<const Buffer*>& buffers);
  ~Kernel();
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;
  // One workgroup per 16x16 pixels; width and height are multiples of 16.
  void run(const FrameConstants& constants);

 private:
  void bind(const std::vector<const Buffer*>& buffers);

  Device& device_;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout pipeline_layout_ = VK_NULL_HANDLE;
  VkDescriptorPool descriptor_pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};
