// SPDX-License-Identifier: Apache-2.0
#include "compute.h"

#include <cstdio>
#include <cstdlib>

namespace {

template <class Info>
Info of_type(VkStructureType type) {
  Info info{};
  info.sType = type;
  return info;
}

void check(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  std::fprintf(stderr, "Vulkan cannot %s (error %d).\n", what, static_cast<int>(result));
  std::exit(1);
}

std::uint32_t compute_queue_family(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
  }
  check(VK_ERROR_FEATURE_NOT_PRESENT, "find a queue for compute shaders");
  return 0;
}

VkInstance create_instance() {
  auto application = of_type<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "tiled_lighting";
  application.apiVersion = VK_API_VERSION_1_1;
  auto info = of_type<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  check(vkCreateInstance(&info, nullptr, &instance), "start; install a driver, for example mesa-vulkan-drivers");
  return instance;
}

VkPhysicalDevice first_physical_device(VkInstance instance) {
  std::uint32_t count = 1;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  const VkResult result = vkEnumeratePhysicalDevices(instance, &count, &physical);
  if (count == 0) check(VK_ERROR_INITIALIZATION_FAILED, "find a device; install mesa-vulkan-drivers");
  if (result != VK_INCOMPLETE) check(result, "list its devices");
  return physical;
}

VkDevice create_device(VkPhysicalDevice physical, std::uint32_t queue_family) {
  const float priority = 1;
  auto queue = of_type<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  auto info = of_type<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  VkDevice device = VK_NULL_HANDLE;
  check(vkCreateDevice(physical, &info, nullptr, &device), "open the device");
  return device;
}

}  // namespace

Device::Device() : instance_(create_instance()), physical_(first_physical_device(instance_)) {
  const std::uint32_t queue_family = compute_queue_family(physical_);
  device_ = create_device(physical_, queue_family);
  vkGetDeviceQueue(device_, queue_family, 0, &queue_);
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  name_ = properties.deviceName;

  auto pool = of_type<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = queue_family;
  check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "make a command pool");
  auto commands = of_type<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  commands.commandPool = pool_;
  commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device_, &commands, &commands_), "make a command list");
}

Device::~Device() {
  vkDestroyCommandPool(device_, pool_, nullptr);
  vkDestroyDevice(device_, nullptr);
  vkDestroyInstance(instance_, nullptr);
}

void Device::begin() {
  auto info = of_type<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  check(vkBeginCommandBuffer(commands_, &info), "record commands");
}

void Device::submit_and_wait() {
  // Makes the shader's writes visible to the CPU.
  auto barrier = of_type<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                       nullptr, 0, nullptr);
  check(vkEndCommandBuffer(commands_), "record commands");
  auto submit = of_type<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "submit commands");
  check(vkQueueWaitIdle(queue_), "finish its commands");
}

std::uint32_t Device::host_visible_memory(std::uint32_t allowed_types) const {
  constexpr VkMemoryPropertyFlags kWanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkPhysicalDeviceMemoryProperties properties;
  vkGetPhysicalDeviceMemoryProperties(physical_, &properties);
  for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    const bool allowed = (allowed_types >> i & 1u) != 0;
    if (allowed && (properties.memoryTypes[i].propertyFlags & kWanted) == kWanted) return i;
  }
  check(VK_ERROR_FEATURE_NOT_PRESENT, "find memory that the CPU can see");
  return 0;
}

Buffer::Buffer(const Device& device, std::size_t bytes) : device_(device.handle()) {
  auto info = of_type<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  check(vkCreateBuffer(device_, &info, nullptr, &buffer_), "make a buffer");
  VkMemoryRequirements needed;
  vkGetBufferMemoryRequirements(device_, buffer_, &needed);
  auto allocation = of_type<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  allocation.allocationSize = needed.size;
  allocation.memoryTypeIndex = device.host_visible_memory(needed.memoryTypeBits);
  check(vkAllocateMemory(device_, &allocation, nullptr, &memory_), "allocate memory");
  check(vkBindBufferMemory(device_, buffer_, memory_, 0), "bind memory");
  check(vkMapMemory(device_, memory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "map memory");
}

Buffer::~Buffer() {
  vkDestroyBuffer(device_, buffer_, nullptr);
  vkFreeMemory(device_, memory_, nullptr);
}

Kernel::Kernel(Device& device, const std::vector<std::uint32_t>& spirv, const std::vector<const Buffer*>& buffers)
    : device_(device) {
  bind(buffers);
  auto module_info = of_type<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  module_info.codeSize = spirv.size() * sizeof(std::uint32_t);
  module_info.pCode = spirv.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device.handle(), &module_info, nullptr, &shader), "read the shader");

  VkPushConstantRange constants{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(FrameConstants)};
  auto layout = of_type<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &set_layout_;
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &constants;
  check(vkCreatePipelineLayout(device.handle(), &layout, nullptr, &pipeline_layout_), "lay out the pipeline");

  auto pipeline = of_type<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  pipeline.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  pipeline.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipeline.stage.module = shader;
  pipeline.stage.pName = "main";
  pipeline.layout = pipeline_layout_;
  check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &pipeline, nullptr, &pipeline_),
        "compile the shader");
  vkDestroyShaderModule(device.handle(), shader, nullptr);
}

void Kernel::bind(const std::vector<const Buffer*>& buffers) {
  const auto count = static_cast<std::uint32_t>(buffers.size());
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  std::vector<VkDescriptorBufferInfo> infos;
  for (std::uint32_t i = 0; i < count; ++i) {
    bindings.push_back({i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    infos.push_back({buffers[i]->handle(), 0, VK_WHOLE_SIZE});
  }
  auto layout = of_type<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  layout.bindingCount = count;
  layout.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(device_.handle(), &layout, nullptr, &set_layout_), "lay out the bindings");

  VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count};
  auto pool = of_type<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool.maxSets = 1;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  check(vkCreateDescriptorPool(device_.handle(), &pool, nullptr, &descriptor_pool_), "make a descriptor pool");
  auto allocation = of_type<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocation.descriptorPool = descriptor_pool_;
  allocation.descriptorSetCount = 1;
  allocation.pSetLayouts = &set_layout_;
  check(vkAllocateDescriptorSets(device_.handle(), &allocation, &set_), "make a descriptor set");

  auto write = of_type<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write.dstSet = set_;
  write.descriptorCount = count;
  write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  write.pBufferInfo = infos.data();  // consecutive bindings continue in the next ones
  vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

Kernel::~Kernel() {
  vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
  vkDestroyPipelineLayout(device_.handle(), pipeline_layout_, nullptr);
  vkDestroyDescriptorPool(device_.handle(), descriptor_pool_, nullptr);
  vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
}

void Kernel::run(const FrameConstants& constants) {
  device_.run([&](VkCommandBuffer commands) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_layout_, 0, 1, &set_, 0, nullptr);
    vkCmdPushConstants(commands, pipeline_layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants, &constants);
    vkCmdDispatch(commands, constants.width / 16, constants.height / 16, 1);
  });
}
