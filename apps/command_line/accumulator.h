// SPDX-License-Identifier: Apache-2.0
// The mean of many frames, and how much single frames vary round it.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "image/image.h"

namespace luciole {

class FrameAccumulator {
 public:
  // All frames have the size and channels of the first one.
  void add(const Image& frame);
  std::uint64_t frame_count() const { return count_; }

  // Every channel's mean over the frames.
  Image mean() const;
  // Adds the layer `variance`: per pixel and colour the sample variance of one frame, over count - 1. The variance of
  // the mean is that divided by the number of frames. Nothing is added to less than two frames.
  void add_variance_layer(Image& image) const;

 private:
  std::uint32_t width_ = 0, height_ = 0;
  std::uint64_t count_ = 0;
  std::map<std::string, std::vector<double>> sums_;
  std::map<std::string, std::vector<double>> squares_;  // of the picture's colours only
};

}  // namespace luciole
