// SPDX-License-Identifier: Apache-2.0
#include "real_time/vulkan_recovery.h"

#include <algorithm>

namespace luciole {
namespace {

constexpr std::uint32_t kSmaller = 16;  // a part is so many times shorter after a loss

}  // namespace

Result<VulkanRecovery> VulkanRecovery::create(const Settings& settings, const gpu::DeviceRequest& request) {
  VulkanRecovery recovery(settings, request);
  Result<std::unique_ptr<VulkanEngine>> engine = VulkanEngine::create(settings, request);
  if (!engine) return engine.error();
  recovery.engine_ = std::move(*engine);
  recovery.device_ = recovery.engine_->device();
  return recovery;
}

Result<std::optional<VulkanRecovery>> VulkanRecovery::chosen_by(Settings& settings) {
  std::optional<VulkanRecovery> chosen;
  const bool automatic = settings.engine == Engine::automatic;
  if (settings.engine == Engine::cpu) return chosen;
  gpu::DeviceRequest request;
  request.wanted = settings.device;
  request.hardware_only = automatic;
  request.validation = settings.vulkan_validation;
  request.in_kernels =
      settings.front == Front::rays || settings.front == Front::cpu;  // they would fail drawing falsely
  request.lost_from_submission = settings.lost_from_submission;
  Result<VulkanRecovery> vulkan = VulkanRecovery::create(settings, request);
  if (!vulkan && !automatic) return vulkan.error();
  settings.engine = vulkan ? Engine::vulkan : Engine::cpu;
  settings.device.clear();
  if (!vulkan) return chosen;
  settings.device = vulkan->device().name;
  chosen.emplace(std::move(*vulkan));
  return chosen;
}

//   with_engine(VulkanEngine&)  -> Result<T>
template <class T, class Attempt>
Result<std::optional<T>> VulkanRecovery::attempt(const Attempt& with_engine, std::vector<std::string>& notes) {
  Result<T> done = with_engine(*engine_);
  if (!done && engine_->lost() && !reopened_) {
    reopened_ = true;
    notes.push_back(done.error().message + "; it is opened anew and gets its work in smaller parts.");
    const std::uint32_t part = std::max(1u, engine_->largest_part() / kSmaller);
    engine_.reset();  // before the next one, as memory may be short
    Result<std::unique_ptr<VulkanEngine>> again = VulkanEngine::create(settings_, request_, part);
    if (!again) {
      notes.push_back(again.error().message + "; the CPU engine goes on.");
      return std::optional<T>();
    }
    engine_ = std::move(*again);
    done = with_engine(*engine_);
  }
  if (done) return std::optional<T>(std::move(*done));
  if (!engine_->lost()) return done.error();
  notes.push_back(done.error().message + " again; the CPU engine goes on.");
  return std::optional<T>();
}

Result<std::optional<VulkanShaded>> VulkanRecovery::shade(const VulkanFrame& frame, std::vector<std::string>& notes) {
  return attempt<VulkanShaded>([&](VulkanEngine& engine) { return engine.shade(frame); }, notes);
}

Result<std::optional<Done>> VulkanRecovery::read_view(std::uint64_t number, SceneToTrace scene,
                                                      const ViewRequest& wanted, const ViewOnHost& to,
                                                      std::vector<std::string>& notes) {
  return attempt<Done>([&](VulkanEngine& engine) { return engine.read_view(number, scene, wanted, to); }, notes);
}

}  // namespace luciole
