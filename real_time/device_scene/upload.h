// SPDX-License-Identifier: Apache-2.0
// Arrays on their way to the device, all in one submission.
#pragma once
#include <cstring>
#include <utility>
#include <vector>

#include "gpu/command_list.h"

namespace luciole {

class Upload {
 public:
  static Result<Upload> begin(gpu::Device& device);

  // A buffer of the device that will hold `bytes`.  fill(void*): writes them
  template <class Fill>
  Status add(std::uint64_t bytes, const Fill& fill, gpu::Buffer& made) {
    if (Status reserved = reserve(bytes, made); !reserved) return reserved;
    if (bytes > 0) fill(staged_.back().template as<void>());
    return Done{};
  }
  template <class T>
  Status add(const std::vector<T>& values, gpu::Buffer& made) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    return add(
        bytes, [&](void* to) { std::memcpy(to, values.data(), bytes); }, made);
  }

  Status finish() { return list_.run(); }  // all is there

 private:
  Upload(gpu::Device& device, gpu::CommandList list) : device_(&device), list_(std::move(list)) {}
  Status reserve(std::uint64_t bytes, gpu::Buffer& made);

  gpu::Device* device_;
  gpu::CommandList list_;
  std::vector<gpu::Buffer> staged_;  // kept until the copies have run
};

}  // namespace luciole
