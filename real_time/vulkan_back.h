// SPDX-License-Identifier: Apache-2.0
// The back half of the frame on a Vulkan device, for the Vulkan engine: temporal accumulation, the filter, and the
// composition of the picture.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "real_time/composition/device_composition_pass.h"
#include "real_time/composition/device_tone_curve_pass.h"
#include "real_time/filtering/device_accumulation_pass.h"
#include "real_time/filtering/device_filter_pass.h"
#include "real_time/pass_timer.h"
#include "real_time/settings.h"
#include "real_time/shading/radiance.h"
#include "real_time/vulkan_front.h"

namespace luciole {

// What shading left of each kind of light, PixelSums; null: nothing.
struct LightSums {
  const gpu::Buffer* indirect = nullptr;
  const gpu::Buffer* more_indirect = nullptr;  // to be added
  const gpu::Buffer* many = nullptr;
};

// What the filter made on the device.
struct FilteredLight {
  Radiance indirect;
  Radiance from_many;            // empty without any
  std::uint64_t not_finite = 0;  // pixels whose noisy light is not, of the one or the other, whichever has more
};

struct BackInputs {
  const ViewOnDevice& seen;
  std::uint64_t view;            // its number
  const GeometryBuffer& screen;  // size and camera
  LightSums sums;
  std::optional<ToneCurve> shown;  // what a screen shows of the picture is wanted, too
};

struct ComposedPicture {
  std::vector<Vec3> picture;        // linear radiance, exposure not applied
  std::vector<std::uint8_t> shown;  // srgb_codes() of it, where BackInputs wants it
  std::uint64_t not_finite = 0;     // pixels: as above, or black for it
};

class VulkanBack {
 public:
  static Result<VulkanBack> create(gpu::Device& device, const Settings& settings);

  bool has_filter() const { return filter_.has_value(); }

  // Filters, and brings the light back.
  Status filter(gpu::Device& device, const BackInputs& inputs, FilteredLight& out, PassTimes& times);
  // Accumulates and filters if the settings say so, adds all up, sends it through the tone curve, and brings the
  // picture back. The view was made on the device.
  Status compose(gpu::Device& device, const BackInputs& inputs, ComposedPicture& out, PassTimes& times);

 private:
  enum Source : std::uint8_t { kIndirect, kMany, kSources };
  VulkanBack() = default;
  Status record_accumulation(gpu::Device& device, gpu::CommandList& list, BackInputs& inputs);
  //   weighed  the sums have their weight
  Status record_filter(gpu::Device& device, gpu::CommandList& list, const BackInputs& inputs, bool weighed);
  Status record_composition(gpu::Device& device, gpu::CommandList& list, BackInputs inputs);
  Status record_tone_curve(gpu::Device& device, gpu::CommandList& list, const BackInputs& inputs);

  std::optional<DeviceAccumulationPass> accumulation_;  // none: the settings want none
  std::optional<DeviceFilterPass> filter_;              // likewise
  DeviceCompositionPass composition_;
  DeviceToneCurvePass tone_curve_;
  float weight_ = 1;  // of sums, n^2
  float exposure_ = 1;
  std::array<gpu::Buffer, kSources> filtered_, filter_counts_;
  gpu::Buffer accumulation_counts_, picture_, composition_counts_, codes_;
  gpu::Buffer received_, received_codes_;
  std::array<gpu::Buffer, kSources> received_filter_counts_;
  gpu::Buffer received_accumulation_counts_, received_composition_counts_;
};

}  // namespace luciole
