// SPDX-License-Identifier: Apache-2.0
// The Vulkan engine: ranges, culling, shading and filtering of a frame on a device, from what the CPU's passes made.
// Its output is that of shade() (shading/shading_pass.h) and of BilateralFilterPass (filtering/bilateral_filter.h).
#pragma once
#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/command_list.h"
#include "real_time/filtering/device_filter_pass.h"
#include "real_time/light_range/light_range_pass.h"
#include "real_time/many_lights/many_lights.h"
#include "real_time/shading/shading_pass.h"
#include "real_time/shading/tile_shading_pass.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"

namespace luciole {

struct VulkanFrame {
  std::uint64_t view;  // another number: geometry and virtual point lights are others, and are sent anew
  const GeometryBuffer& geometry;
  const VirtualPointLights& vpls;
  const ManyLights& many;
  RangeParameters range;
  std::uint32_t shift;           // as in ShadingInputs
  bool count_per_pixel = false;  // likewise
  bool lobes_apart = false;
  bool filter = false;     // filter here, if the settings want a filter; else the noisy light comes back
  bool noisy_too = false;  // it comes back even so
};

// What the filter made on the device.
struct FilteredLight {
  Radiance indirect;
  Radiance from_many;            // empty without any
  std::uint64_t not_finite = 0;  // pixels whose noisy light is not, of the one or the other, whichever has more
};

struct VulkanShaded {
  ShadingOutputs shaded;                  // where `filtered` is there without `noisy_too`, no indirect and from_many
  std::optional<FilteredLight> filtered;  // where VulkanFrame and the settings want it
  std::vector<std::pair<std::string, double>> passes_ms;  // light_range, culling_and_shading, filtering, transfer
};

class VulkanEngine {
 public:
  // Whether the engine can do what the settings ask; else one sentence.
  static Status can_do(const Settings& settings);

  //   largest_part  lights of a subset that one submission asks; 0: what suits the device
  static Result<std::unique_ptr<VulkanEngine>> create(const Settings& settings, const gpu::DeviceRequest& request,
                                                      std::uint32_t largest_part = 0);

  Result<VulkanShaded> shade(const VulkanFrame& frame);

  const gpu::DeviceDescription& device() const { return device_->description(); }
  bool lost() const { return device_->lost(); }
  std::uint32_t largest_part() const { return largest_part_; }

  // What light_range left on the device, for tests.
  Result<std::vector<char>> read_emitters(LightKind kind);
  Result<std::vector<char>> read_bounds(LightKind kind);

 private:
  VulkanEngine(std::unique_ptr<gpu::Device> device, const Settings& settings)
      : device_(std::move(device)), settings_(settings) {}
  Status prepare(const VulkanFrame& frame, gpu::CommandList& list);  // memory, and what is sent
  Status send_view(const VulkanFrame& frame, gpu::CommandList& list);
  Status send_many_lights(const VulkanFrame& frame, gpu::CommandList& list);
  Status make_outputs(const VulkanFrame& frame);
  template <class Record, class Pack>
  Status send(gpu::CommandList& list, std::size_t count, const Pack& pack, gpu::Buffer& to);
  Status grow(gpu::Buffer& buffer, std::uint64_t bytes, gpu::BufferUse use);
  Status run(gpu::CommandList& list);
  Status run_parts(const VulkanFrame& frame);
  bool filters(const VulkanFrame& frame) const { return frame.filter && filter_.has_value(); }
  Status filter(const VulkanFrame& frame, FilteredLight& out);
  Status filter_sums(const GeometryBuffer& geometry, std::initializer_list<LightKind> kinds, FilteredLight& out,
                     Radiance& light);
  void clear_outputs(const VulkanFrame& frame, ShadingOutputs& out) const;
  Status collect(const VulkanFrame& frame, ShadingOutputs& out);
  Result<std::vector<char>> read(const gpu::Buffer& buffer, std::uint64_t bytes);

  std::unique_ptr<gpu::Device> device_;  // first: it outlives what follows
  Settings settings_;
  std::uint32_t largest_part_ = 0;
  LightRangePass ranges_;
  TileShadingPass shading_;
  std::optional<DeviceFilterPass> filter_;  // none: the settings want no filter
  gpu::Buffer range_frame_, pixels_, vpls_, many_, vpl_subsets_, many_subsets_;
  std::array<LightsOnDevice, kLightKinds> lights_;
  std::array<gpu::Buffer, kLightKinds> sums_, tile_counts_;
  gpu::Buffer filtered_, filter_counts_;
  gpu::Buffer received_pixels_, received_counts_;
  std::vector<gpu::Buffer> sent_;  // kept until the copies have run
  std::uint32_t longest_subset_vpls_ = 0, longest_subset_many_ = 0;
  std::uint64_t view_ = ~std::uint64_t{0};
  std::vector<std::pair<std::string, double>> passes_ms_;
};

}  // namespace luciole
