// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/accumulator.h"

#include <algorithm>

namespace luciole {
namespace {

constexpr const char* kColours[] = {"R", "G", "B"};

}  // namespace

void FrameAccumulator::add(const Image& frame) {
  width_ = frame.width, height_ = frame.height;
  ++count_;
  for (const auto& [name, values] : frame.channels) {
    std::vector<double>& sum = sums_[name];
    sum.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i];
  }
  for (const char* name : kColours) {
    const std::vector<float>& values = frame.channels.at(name);
    std::vector<double>& square = squares_[name];
    square.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) square[i] += double(values[i]) * values[i];
  }
}

Image FrameAccumulator::mean() const {
  Image image;
  image.width = width_, image.height = height_;
  for (const auto& [name, sum] : sums_) {
    std::vector<float>& values = image.channels[name];
    values.resize(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) values[i] = static_cast<float>(sum[i] / double(count_));
  }
  return image;
}

void FrameAccumulator::add_variance_layer(Image& image) const {
  if (count_ < 2) return;
  for (const char* name : kColours) {
    const std::vector<double>&sum = sums_.at(name), &square = squares_.at(name);
    std::vector<float>& values = image.channels[std::string("variance.") + name];
    values.resize(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const double mean = sum[i] / double(count_);
      // Floats squared are exact in double, so the difference keeps about 1e-15 of the square; below is rounding.
      values[i] = static_cast<float>(std::max(square[i] - mean * sum[i], 0.0) / double(count_ - 1));
    }
  }
}

}  // namespace luciole
