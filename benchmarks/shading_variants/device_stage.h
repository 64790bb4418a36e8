// SPDX-License-Identifier: Apache-2.0
// What culling and shading read and write, on a device, without the engine around them: for kernels beside the
// engine's.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <vector>

#include "gpu/command_list.h"
#include "real_time/light_range/light_range_pass.h"
#include "real_time/many_lights/many_lights.h"
#include "real_time/shading/tile_shading_pass.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"

namespace luciole {

// What the CPU's passes made. Must outlive the stage.
struct StageInputs {
  const Settings& settings;
  const GeometryBuffer& geometry;
  const VirtualPointLights& vpls;
  const ManyLights& many;
};

using DeviceLights = std::array<LightsOnDevice, kLightKinds>;

class DeviceStage {
 public:
  static Result<std::unique_ptr<DeviceStage>> create(gpu::Device& device, const StageInputs& inputs);
  DeviceStage(const DeviceStage&) = delete;
  DeviceStage& operator=(const DeviceStage&) = delete;

  const Settings& settings() const { return inputs_.settings; }
  const GeometryBuffer& geometry() const { return inputs_.geometry; }
  const DeviceLights& lights() const { return lights_; }                         // by the stage's own settings
  std::uint32_t longest_subset(LightKind kind) const { return longest_[kind]; }  // 0: there are no lights of this kind
  std::vector<LightKind> kinds() const;                                          // of which there are lights

  // The same lights with the bounds that other settings choose, prepared for their tile test.
  Result<DeviceLights> make_lights(const Settings& settings);

  ShadingBuffers buffers(LightKind kind, const DeviceLights& lights) const;
  ShadingPush push(LightKind kind) const;  // all lights of the kind at once

  // What pack writes into memory of so many bytes, in a buffer of the device.
  Result<gpu::Buffer> send(std::uint64_t bytes, const std::function<void(void*)>& pack);

  // Sums that no kernel writes, so that what a variant leaves out shows.
  Status forget_sums();
  Result<std::vector<PixelSums>> read_sums(LightKind kind);
  Result<std::vector<TileCounts>> read_counts(LightKind kind);  // of tiles of 16x16 pixels

 private:
  DeviceStage(gpu::Device& device, const StageInputs& inputs) : device_(device), inputs_(inputs) {}
  Status send_frame();
  template <class Record, class Lights>
  Status send_lights(const Lights& lights, std::initializer_list<LightKind> kinds, gpu::Buffer& records,
                     gpu::Buffer& subsets);
  Status make_outputs();
  template <class Record, class Write>
  Status send_records(std::size_t count, const Write& write, gpu::Buffer& to);
  template <class Record>
  Result<std::vector<Record>> read(const gpu::Buffer& buffer, std::size_t count);

  gpu::Device& device_;
  StageInputs inputs_;
  gpu::Buffer range_frame_, pixels_, vpls_, many_, vpl_subsets_, many_subsets_;
  std::array<std::uint32_t, kLightKinds> entries_{}, longest_{};
  DeviceLights lights_;
  std::array<gpu::Buffer, kLightKinds> sums_, tile_counts_;
};

}  // namespace luciole
