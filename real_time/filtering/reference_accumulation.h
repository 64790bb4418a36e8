// SPDX-License-Identifier: Apache-2.0
// Temporal accumulation once more for its tests: in double, with how far float may be from that.
#pragma once
#include <array>
#include <vector>

#include "real_time/filtering/past_view.h"
#include "real_time/shading/radiance.h"

namespace luciole {

// A value, and by how much float may differ from it on any engine.
struct Uncertain {
  double value = 0, error = 0;
};

class ReferenceAccumulation {
 public:
  using Light = std::array<Uncertain, 12>;  // indirect diffuse and specular, the same of many lights
  struct Pixel {
    Uncertain diffuse_frames, specular_frames;
    Light light{};
    // Float may decide otherwise whether a pixel of the past saw this surface, here or in the history of what it takes.
    bool contested = false;
  };

  //   longest  as in TemporalAccumulationPass::Inputs
  explicit ReferenceAccumulation(std::uint32_t longest) : most_(longest - 1) {}

  // The next frame; light is finite.
  void run(const GeometryBuffer& geometry, std::uint64_t view, const Radiance& indirect, const Radiance& many);

  const std::vector<Pixel>& pixels() const { return pixels_; }

 private:
  struct Tap {
    std::size_t pixel = 0;
    Uncertain weight;
  };
  struct Taps {
    std::vector<Tap> taps;
    bool contested = false;
  };
  Taps taps_of(const GeometryBuffer& geometry, WayBack way, std::size_t pixel) const;
  void add(Taps& taps, const GeometryBuffer& geometry, std::size_t pixel, std::size_t past, Uncertain weight,
           Uncertain pixel_width) const;
  Pixel go_on(const GeometryBuffer& geometry, const Taps& taps, std::size_t pixel, const Light& now) const;

  double most_;
  FrameView view_;
  GeometryBuffer past_;
  std::vector<Pixel> past_pixels_, pixels_;
};

}  // namespace luciole
