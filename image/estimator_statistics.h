// SPDX-License-Identifier: Apache-2.0
// What many frames of one estimator have in common: sums per pixel, per block of dark pixels, and of the whole picture.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "image/image.h"

namespace luciole {

using Colour = std::array<double, 3>;  // R, G, B
inline Colour colour_of(Vec3 v) { return {double(v.x), double(v.y), double(v.z)}; }

// What the reference pass knows about one frame of the estimator under test; each width * height, row 0 on top.
struct FrameExpectation {
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> mean;       // the reference, radiance [W/(m^2 sr)]
  std::vector<Vec3> variance;   // of one frame, each channel for itself: sum of L_c^2 (1/p - 1) and coupling terms
  std::vector<float> accepted;  // accepted lights of one frame: sum of p
};

// From the layers of a reference: "reference" (without it, the picture), "predicted_variance" (R, G, B) and
// "predicted_accepted" (V).
Result<FrameExpectation> frame_expectation(const Image& reference);

// Dark pixels accept lights so rarely that their mean over all frames is far from normal. They are tested together:
// those of an 8x8 block, or of a block twice, four times, .. as wide, up to the picture.
class EstimatorStatistics {
 public:
  static constexpr std::uint32_t kSmallestBlock = 8;  // [pixels]
  static constexpr double kEnoughAccepted = 100;      // expected accepted lights in all frames

  // `frames`: how many will be added.
  EstimatorStatistics(FrameExpectation expectation, std::uint32_t frames);

  // One frame of the estimator, width * height pixels, finite.
  void add(const std::vector<Vec3>& frame);

  // The dark pixels within one square, as one value: their mean difference from the reference, frame by frame.
  struct Block {
    std::uint32_t pixels = 0;
    double accepted = 0;                                // lights expected in one frame, all pixels together
    Colour reference{};                                 // mean over the pixels
    std::array<bool, 3> random{};                       // whether any of the pixels has variance, by channel
    Colour sum{}, squares{}, cubes{}, fourth_powers{};  // of the difference, over frames
  };
  struct BlockLevel {
    std::uint32_t side = 0, columns = 0, rows = 0;  // side in pixels
    std::vector<Block> blocks;
  };

  const FrameExpectation& expectation() const { return expectation_; }
  std::uint32_t planned_frames() const { return planned_frames_; }
  std::uint32_t frames() const { return frames_; }
  bool is_dark(std::size_t pixel) const { return dark_[pixel]; }
  // Differences from the reference, sums over frames.
  const std::vector<Colour>& pixel_sums() const { return pixel_sums_; }
  const std::vector<Colour>& pixel_squares() const { return pixel_squares_; }
  // From the smallest blocks to the one that is the picture; empty without dark pixels.
  const std::vector<BlockLevel>& block_levels() const { return block_levels_; }
  // The picture's mean luminance, difference from the reference's, one per frame.
  const std::vector<double>& picture_differences() const { return picture_differences_; }
  // The frames' mean picture.
  std::vector<Vec3> mean() const;

 private:
  void make_block_levels();
  void add_pixel_to_blocks(std::size_t pixel);
  void add_to_blocks(const std::vector<Vec3>& frame);
  std::size_t smallest_block_of(std::size_t pixel) const;

  FrameExpectation expectation_;
  std::uint32_t planned_frames_ = 0, frames_ = 0;
  std::vector<bool> dark_;
  std::vector<Colour> pixel_sums_, pixel_squares_;
  std::vector<BlockLevel> block_levels_;
  std::vector<double> picture_differences_;
};

}  // namespace luciole
