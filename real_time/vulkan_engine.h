// SPDX-License-Identifier: Apache-2.0
// The Vulkan engine: a frame's passes on a device. Ranges, culling, shading and filtering always; what is before them
// (vulkan_front.h) if the settings' front is not the CPU, else from what the CPU's passes made. Its output is that of
// shade() (shading/shading_pass.h), of BilateralFilterPass (filtering/bilateral_filter.h) and of compose()
// (composition/).
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/command_list.h"
#include "real_time/light_range/light_range_pass.h"
#include "real_time/many_lights/many_lights.h"
#include "real_time/pass_timer.h"
#include "real_time/shading/device_shading.h"
#include "real_time/shading/shading_pass.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"
#include "real_time/vulkan_back.h"
#include "real_time/vulkan_front.h"

namespace luciole {

struct VulkanFrame {
  std::uint64_t view;  // another number: geometry and virtual point lights are others, and are sent or made anew
  const GeometryBuffer& geometry;
  const VirtualPointLights& vpls;
  const ManyLights& many;
  RangeParameters range;
  std::uint32_t shift;           // as in ShadingInputs
  bool count_per_pixel = false;  // likewise
  bool lobes_apart = false;
  bool filter = false;     // filter here, if the settings want a filter; else the noisy light comes back
  bool noisy_too = false;  // it comes back even so
  const ViewRequest* made_here = nullptr;  // of it the engine makes the view, and none is sent
  bool compose = false;  // such a view's picture is composed here, and nothing but that and counts comes back
  SceneToTrace scene = {};
  std::optional<ToneCurve> shown = {};  // and what a screen shows of it
};

struct VulkanShaded {
  ShadingOutputs shaded;                    // where `filtered` is there without `noisy_too`, no indirect and from_many
  std::optional<FilteredLight> filtered;    // where VulkanFrame and the settings want it
  std::optional<ComposedPicture> composed;  // where VulkanFrame wants it; then nothing of the light is elsewhere
  std::uint64_t vpl_count = 0;
  PassTimes passes_ms;  // of the view if it was made here, light_range, culling_and_shading, filtering, transfer
};

class VulkanEngine {
 public:
  //   largest_part  lights of a subset that one submission asks; 0: what suits the device
  static Result<std::unique_ptr<VulkanEngine>> create(const Settings& settings, const gpu::DeviceRequest& request,
                                                      std::uint32_t largest_part = 0);

  Result<VulkanShaded> shade(const VulkanFrame& frame);

  // Whether the engine makes views; else they are sent.
  bool has_front() const { return front_.has_value(); }
  // Makes the view of that number unless it is the last one, and brings it back.
  Status read_view(std::uint64_t number, SceneToTrace scene, const ViewRequest& wanted, const ViewOnHost& to);

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
  Status send_scene(SceneToTrace scene);
  Status make_view(std::uint64_t number, SceneToTrace scene, const ViewRequest& wanted);
  Status send_view(const VulkanFrame& frame, gpu::CommandList& list);
  void count_vpls();
  Status send_many_lights(const VulkanFrame& frame, gpu::CommandList& list);
  Status make_outputs(const VulkanFrame& frame);
  template <class Record, class Pack>
  Status send(gpu::CommandList& list, std::size_t count, const Pack& pack, gpu::Buffer& to);
  Status grow(gpu::Buffer& buffer, std::uint64_t bytes, gpu::BufferUse use) {
    return gpu::grow(*device_, buffer, bytes, use);
  }
  Status run(gpu::CommandList& list);
  Status shade_lights(const VulkanFrame& frame);
  Status prepare_shadows(SceneToTrace scene);
  bool filters(const VulkanFrame& frame) const { return frame.filter && back_->has_filter() && !frame.compose; }
  LightSums light_sums() const;
  Status finish(const VulkanFrame& frame, VulkanShaded& out);
  void clear_outputs(const VulkanFrame& frame, ShadingOutputs& out) const;
  Status collect(const VulkanFrame& frame, ShadingOutputs& out);
  Result<std::vector<char>> read(const gpu::Buffer& buffer, std::uint64_t bytes);

  std::unique_ptr<gpu::Device> device_;  // first: it outlives what follows
  Settings settings_;
  std::uint32_t largest_part_ = 0;
  std::optional<VulkanFront> front_;  // none: views are sent
  LightRangePass ranges_;
  DeviceShading shading_;
  std::optional<VulkanBack> back_;
  std::optional<DeviceScene> scene_;
  std::uint64_t scene_number_ = 0;
  gpu::Buffer shadows_, unfinished_;  // ShadowRecord, and its count of rays
  ViewOnDevice seen_;
  gpu::Buffer range_frame_, many_, many_subsets_;
  std::array<LightsOnDevice, kLightKinds> lights_;
  std::array<gpu::Buffer, kLightKinds> sums_, tile_counts_;
  gpu::Buffer received_pixels_, received_counts_;
  std::vector<gpu::Buffer> sent_;  // kept until the copies have run
  std::uint32_t longest_subset_many_ = 0;
  std::uint64_t view_ = ~std::uint64_t{0};
  PassTimes passes_ms_;
  double read_ms_ = 0;  // for views that were read back since the last frame
};

}  // namespace luciole
