// SPDX-License-Identifier: Apache-2.0
// A picture on a Vulkan device -> what a screen shows of it: the kernel tone_curve.comp. The codes are those that
// to_display() and write_png() give.
#pragma once
#include "gpu/command_list.h"
#include "image/tone_curve.h"
#include "real_time/composition/composition_records.h"

namespace luciole {

class DeviceToneCurvePass {
 public:
  // Sends the edges of the codes once.
  static Result<DeviceToneCurvePass> create(gpu::Device& device);

  //   exposure  scale E [m^2 sr/W]
  //   picture   PixelColour, width * height, linear radiance
  //   codes     4 bytes per pixel: red, green, blue, 255
  void record(gpu::CommandList& list, const gpu::Buffer& picture, const gpu::Buffer& codes, std::uint32_t width,
              std::uint32_t height, float exposure, ToneCurve curve) const;

 private:
  gpu::Kernel kernel_;
  gpu::Buffer edges_;
};

}  // namespace luciole
