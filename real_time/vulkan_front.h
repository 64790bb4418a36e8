// SPDX-License-Identifier: Apache-2.0
// The front half of the frame on a Vulkan device, for the Vulkan engine: geometry buffer, reflective shadow maps,
// virtual point lights and direct light.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "real_time/direct_light/device_direct_light_pass.h"
#include "real_time/geometry_buffer/raster_geometry_pass.h"
#include "real_time/reflective_shadow_map/device_light_map_pass.h"
#include "real_time/settings.h"
#include "real_time/virtual_point_lights/device_placement_pass.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"

namespace luciole {

// For rays on the device: of views that are made there, and of --direct-shadows.
struct SceneToTrace {
  std::uint64_t number = 0;  // another number: another scene, which is sent
  const RayScene* rays = nullptr;
};

// Of what a view is made.
struct ViewRequest {
  std::uint64_t maps_number = 0;  // another number: other maps
  const RayScene* rays = nullptr;
  const ReflectiveShadowMaps* maps = nullptr;  // of `lights`
  TexelSampling sampling;
  PrimaryLights lights;
  DeviceView view;
};

// A view in the device's memory: made there, or sent.
struct ViewOnDevice {
  GeometryOnDevice geometry;  // of a view that was sent only the pixels
  gpu::Buffer direct;         // 3 floats per pixel [W/(m^2 sr)]; none where it was sent
  gpu::Buffer vpls;           // VplRecord, in the order of subset_layout
  gpu::Buffer subsets;        // SubsetRange, n^2 of them
  std::uint32_t entries = 0, longest_subset = 0;
  std::uint64_t vpl_count = 0;
};

// The same in the CPU's memory.
struct ViewOnHost {
  GeometryBuffer& geometry;
  VirtualPointLights& vpls;
  Plane3& direct;
};

class VulkanFront {
 public:
  //   settings  front: rays or raster
  static Result<VulkanFront> create(gpu::Device& device, const Settings& settings);

  // Fails where rays met more of the scene than kernels can ask.  scene: that of wanted.rays
  Status render(gpu::Device& device, const DeviceScene& scene, const ViewRequest& wanted, ViewOnDevice& made);
  // Of the last view, by the device's clock.
  const std::vector<std::pair<std::string, double>>& passes_ms() const { return passes_ms_; }

 private:
  VulkanFront() = default;
  Status prepare_geometry(gpu::Device& device, const DeviceScene& scene, const DeviceView& view);
  Status prepare(gpu::Device& device, const ViewRequest& wanted, ViewOnDevice& made);
  Status run(gpu::Device& device, const DeviceScene& scene, const ViewRequest& wanted, ViewOnDevice& made);
  Status read_counts(gpu::Device& device, ViewOnDevice& made) const;

  std::optional<DeviceGeometryPass> traced_;
  std::optional<RasterGeometryPass> rasterised_;  // of scenes with at most that many meshes; made with the first
  std::uint32_t most_meshes_ = 0;
  DeviceLightMapPass light_maps_;
  DevicePlacementPass placement_;
  DeviceDirectLightPass direct_;
  std::uint32_t subsets_ = 1;
  std::optional<LightMapsOnDevice> maps_;
  std::uint64_t maps_number_ = 0;
  TexelsOnDevice texels_;
  gpu::Buffer sources_;
  std::uint32_t source_count_ = 0;
  std::vector<std::pair<std::string, double>> passes_ms_;
};

// Brings a view that was made on the device back, lights in the order of their keys, as the CPU's passes have them.
Status read_back(gpu::Device& device, const ViewOnDevice& from, const DeviceView& view, const ViewOnHost& to);

}  // namespace luciole
