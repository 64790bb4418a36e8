// SPDX-License-Identifier: Apache-2.0
#include "image/estimator_statistics.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "image/tone_curve.h"

namespace luciole {
namespace {

Colour difference(Vec3 value, Vec3 reference) {
  const Colour a = colour_of(value), b = colour_of(reference);
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

Result<FrameExpectation> frame_expectation(const Image& reference) {
  FrameExpectation expectation{reference.width,
                               reference.height,
                               reference.colours(reference.has_layer("reference") ? "reference" : ""),
                               reference.colours("predicted_variance"),
                               {}};
  const auto accepted = reference.channels.find("predicted_accepted.V");
  if (expectation.mean.empty() || expectation.variance.empty() || accepted == reference.channels.end() ||
      accepted->second.size() != reference.pixel_count()) {
    return Error{ErrorKind::failed,
                 "the reference lacks the picture or its layers predicted_variance and predicted_accepted"};
  }
  expectation.accepted = accepted->second;
  return expectation;
}

EstimatorStatistics::EstimatorStatistics(FrameExpectation expectation, std::uint32_t frames)
    : expectation_(std::move(expectation)), planned_frames_(frames) {
  const std::size_t count = expectation_.mean.size();
  LUCIOLE_ASSERT_EQ(count, std::size_t(expectation_.width) * expectation_.height);
  LUCIOLE_ASSERT_EQ(count, expectation_.variance.size());
  LUCIOLE_ASSERT_EQ(count, expectation_.accepted.size());
  pixel_sums_.resize(count);
  pixel_squares_.resize(count);
  dark_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    // A pixel without variance is not random at all: it is tested alone, and exactly.
    const Vec3 variance = expectation_.variance[i];
    const bool random = variance.x > 0 || variance.y > 0 || variance.z > 0;
    dark_[i] = random && double(expectation_.accepted[i]) * frames < kEnoughAccepted;
  }
  if (std::find(dark_.begin(), dark_.end(), true) != dark_.end()) make_block_levels();
}

std::size_t EstimatorStatistics::smallest_block_of(std::size_t pixel) const {
  const std::size_t x = pixel % expectation_.width, y = pixel / expectation_.width;
  return y / kSmallestBlock * block_levels_.front().columns + x / kSmallestBlock;
}

void EstimatorStatistics::make_block_levels() {
  for (std::uint32_t side = kSmallestBlock;; side *= 2) {
    BlockLevel level{side, (expectation_.width + side - 1) / side, (expectation_.height + side - 1) / side, {}};
    level.blocks.resize(std::size_t(level.columns) * level.rows);
    block_levels_.push_back(std::move(level));
    if (block_levels_.back().blocks.size() == 1) break;
  }
  for (std::size_t i = 0; i < dark_.size(); ++i) {
    if (dark_[i]) add_pixel_to_blocks(i);
  }
  for (BlockLevel& level : block_levels_) {
    for (Block& block : level.blocks) {
      for (double& reference : block.reference) reference /= std::max(1u, block.pixels);
    }
  }
}

void EstimatorStatistics::add_pixel_to_blocks(std::size_t pixel) {
  const std::size_t x = pixel % expectation_.width, y = pixel / expectation_.width;
  const Colour reference = colour_of(expectation_.mean[pixel]), variance = colour_of(expectation_.variance[pixel]);
  for (BlockLevel& level : block_levels_) {
    Block& block = level.blocks[y / level.side * level.columns + x / level.side];
    block.pixels += 1;
    block.accepted += double(expectation_.accepted[pixel]);
    for (std::size_t c = 0; c < 3; ++c) {
      block.reference[c] += reference[c];
      block.random[c] = block.random[c] || variance[c] > 0;
    }
  }
}

void EstimatorStatistics::add_to_blocks(const std::vector<Vec3>& frame) {
  std::vector<Colour> differences(block_levels_.front().blocks.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (!dark_[i]) continue;
    const Colour pixel = difference(frame[i], expectation_.mean[i]);
    Colour& block = differences[smallest_block_of(i)];
    for (std::size_t c = 0; c < 3; ++c) block[c] += pixel[c];
  }
  for (std::size_t l = 0; l < block_levels_.size(); ++l) {
    BlockLevel& level = block_levels_[l];
    for (std::size_t b = 0; b < level.blocks.size(); ++b) {
      Block& block = level.blocks[b];
      if (block.pixels == 0) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const double mean = differences[b][c] / block.pixels;
        block.sum[c] += mean;
        block.squares[c] += mean * mean;
        block.cubes[c] += mean * mean * mean;
        block.fourth_powers[c] += mean * mean * mean * mean;
      }
    }
    if (l + 1 == block_levels_.size()) break;
    const BlockLevel& next = block_levels_[l + 1];
    std::vector<Colour> merged(next.blocks.size());
    for (std::size_t b = 0; b < differences.size(); ++b) {
      const std::size_t row = b / level.columns / 2, column = b % level.columns / 2;
      for (std::size_t c = 0; c < 3; ++c) merged[row * next.columns + column][c] += differences[b][c];
    }
    differences = std::move(merged);
  }
}

void EstimatorStatistics::add(const std::vector<Vec3>& frame) {
  LUCIOLE_ASSERT_EQ(frame.size(), expectation_.mean.size());
  double luminance_difference = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Colour pixel = difference(frame[i], expectation_.mean[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      pixel_sums_[i][c] += pixel[c];
      pixel_squares_[i][c] += pixel[c] * pixel[c];
    }
    luminance_difference += 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
  }
  picture_differences_.push_back(luminance_difference / static_cast<double>(frame.size()));
  if (!block_levels_.empty()) add_to_blocks(frame);
  ++frames_;
}

std::vector<Vec3> EstimatorStatistics::mean() const {
  std::vector<Vec3> mean(pixel_sums_.size());
  const double scale = frames_ == 0 ? 0.0 : 1.0 / frames_;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const auto& sum = pixel_sums_[i];
    mean[i] = expectation_.mean[i] + Vec3(float(sum[0] * scale), float(sum[1] * scale), float(sum[2] * scale));
  }
  return mean;
}

}  // namespace luciole
