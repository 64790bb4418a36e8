// SPDX-License-Identifier: Apache-2.0
// What happens when the device is lost: once in a run it is opened anew and asked with smaller parts; if that fails,
// the CPU engine takes over.
#pragma once
#include <optional>

#include "real_time/vulkan_engine.h"

namespace luciole {

class VulkanRecovery {
 public:
  static Result<VulkanRecovery> create(const Settings& settings, const gpu::DeviceRequest& request);

  // The engine that the settings ask for, which are made to say what was chosen; none: the CPU.
  static Result<std::optional<VulkanRecovery>> chosen_by(Settings& settings);

  bool has_front() const { return engine_->has_front(); }

  // None: the device is gone for good, and the caller does the frame by itself. What happened is added to `notes`.
  Result<std::optional<VulkanShaded>> shade(const VulkanFrame& frame, std::vector<std::string>& notes);
  // VulkanEngine::read_view, likewise.
  Result<std::optional<Done>> read_view(std::uint64_t number, SceneToTrace scene, const ViewRequest& wanted,
                                        const ViewOnHost& to, std::vector<std::string>& notes);

  const gpu::DeviceDescription& device() const { return device_; }

 private:
  VulkanRecovery(const Settings& settings, const gpu::DeviceRequest& request)
      : settings_(settings), request_(request) {}

  template <class T, class Attempt>
  Result<std::optional<T>> attempt(const Attempt& with_engine, std::vector<std::string>& notes);

  Settings settings_;
  gpu::DeviceRequest request_;
  std::unique_ptr<VulkanEngine> engine_;
  gpu::DeviceDescription device_;
  bool reopened_ = false;
};

}  // namespace luciole
