// SPDX-License-Identifier: Apache-2.0
// Door: the noisy light of one frame after the other in, its mean over the frames out. Each pixel finds the surface
// that it sees in the frame before, through that frame's camera, and goes on from the mean that was reached there.
// Ranges and offsets are drawn anew in every frame, so that the mean of a view that stands still is without bias and
// converges.
#pragma once
#include <cstdint>
#include <vector>

#include "real_time/filtering/past_view.h"
#include "real_time/shading/radiance.h"

namespace luciole {

struct PastLight {
  Vec3 diffuse{0, 0, 0}, specular{0, 0, 0};
};

class TemporalAccumulationPass {
 public:
  struct Inputs {
    const GeometryBuffer& geometry;
    std::uint64_t view;     // a number of this geometry: in frames of the same one every pixel sees what it saw
    std::uint32_t longest;  // frames that a mean may count; the weight of a new one is never below 1 / longest. >= 2
  };

  // Replaces the light of every surface by its mean; both of the size of the geometry, or without planes.
  // - Where the surface was not seen in the frame before, the light stays as it is.
  // - Light that is not finite takes no part; where there is no mean either, it stays.
  // - The same bits for any number of threads.
  void run(const Inputs& inputs, Radiance& indirect, Radiance& many);

  // Frames in the mean of each pixel's diffuse light, this one among them; 0: the sky.
  const Plane& frames() const { return frames_; }

 private:
  // What a pixel saw, and how many frames its means count.
  struct PastSurface {
    Vec3 position, normal, geometric_normal;
    std::uint32_t material;
    float diffuse_frames, specular_frames;  // 0: the sky
  };
  struct Past {
    FrameView view;
    AlignedVector<PastSurface> surface;
    AlignedVector<PastLight> indirect, many;  // many: none without such light
  };
  struct Tap {
    std::size_t pixel;
    float weight;
  };
  // At most four pixels of the past that saw the surface of a pixel, and their weights, whose sum is 1.
  struct Taps {
    Tap tap[4];
    int count = 0;
  };
  struct Means {
    PastSurface surface;
    PastLight indirect, many;
  };
  class Reprojection;

  static PastSurface surface_of(const GeometryBuffer& geometry, std::size_t pixel);
  Means means_before(const PastSurface& seen, const Taps& taps) const;
  void go_on(const Inputs& inputs, const Reprojection& reprojection, std::size_t pixel, Radiance& indirect,
             Radiance& many);

  Past past_, present_;
  Plane frames_;
};

}  // namespace luciole
