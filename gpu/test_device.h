// SPDX-License-Identifier: Apache-2.0
// What tests on a Vulkan device share.
#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <vector>

#include "gpu/command_list.h"

namespace luciole::gpu::test {

// A device, or a failed test: mesa-vulkan-drivers brings one to every machine.
inline std::unique_ptr<Device> open_device(const DeviceRequest& request = {}) {
  Result<std::unique_ptr<Device>> device = Device::create(request);
  EXPECT_TRUE(device.has_value()) << device.error().message;
  return device ? std::move(*device) : nullptr;
}

inline std::unique_ptr<Device> open_validated_device() {
  DeviceRequest request;
  request.validation = true;
  return open_device(request);
}

inline Buffer make_buffer(Device& device, std::uint64_t bytes, BufferUse use) {
  Result<Buffer> buffer = Buffer::create(device, bytes, use);
  EXPECT_TRUE(buffer.has_value()) << buffer.error().message;
  return buffer ? std::move(*buffer) : Buffer();
}

template <class T>
Buffer upload_of(Device& device, const std::vector<T>& values) {
  Buffer buffer = make_buffer(device, values.size() * sizeof(T), BufferUse::upload);
  std::memcpy(buffer.as<void>(), values.data(), values.size() * sizeof(T));
  return buffer;
}

template <class T>
std::vector<T> values_in(const Buffer& buffer, std::size_t count) {
  return std::vector<T>(buffer.as<T>(), buffer.as<T>() + count);
}

inline CommandList make_list(Device& device) {
  Result<CommandList> list = CommandList::create(device);
  EXPECT_TRUE(list.has_value()) << list.error().message;
  return std::move(*list);
}

inline Kernel make_kernel(Device& device, const ShaderCode& code, std::uint32_t push_bytes,
                          const std::vector<std::uint32_t>& constants = {}) {
  Result<Kernel> kernel = Kernel::create(device, code, push_bytes, constants);
  EXPECT_TRUE(kernel.has_value()) << kernel.error().message;
  return kernel ? std::move(*kernel) : Kernel();
}

}  // namespace luciole::gpu::test
