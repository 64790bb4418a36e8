// SPDX-License-Identifier: Apache-2.0
// Figures for the difference of a picture x from a reference r. Means run over all pixels and their three channels.
#pragma once
#include <vector>

#include "base/result.h"
#include "image/flip.h"
#include "image/image.h"
#include "image/tone_curve.h"

namespace luciole {

struct Comparison {
  double rmse = 0;  // sqrt(mean((x - r)^2))
  // sqrt(mean((x' - r')^2)), v' = min(max(E v, 0), 1): as seen on a display without a tone curve, where a white spot is
  // white however bright it is. [0,1]
  double display_rmse = 0;
  double relmse = 0;              // mean((x - r)^2 / (r^2 + 0.01 mean(r)^2)); infinite against a black reference
  double flip = 0;                // mean of flip_map over both pictures as they would be displayed, [0,1]
  double largest_difference = 0;  // max |x - r|
  double mean_ratio = 1;          // mean(x) / mean(r); infinite against a black reference
};

// Only FLIP and display_rmse depend on how the pictures are displayed; the other figures are of the linear values.
struct ComparisonSettings {
  float exposure = 1;  // E, multiplies both pictures
  ToneCurve tone_curve = ToneCurve::pbr_neutral;
  float pixels_per_degree = kFlipPixelsPerDegree;
};

// Where the differences are: one value per pixel, row 0 on top.
struct DifferenceMaps {
  // sqrt of the mean over channels of (x - r)^2 / (r^2 + 0.01 mean(r)^2): the mean of its square is relmse.
  std::vector<float> relative_error;
  std::vector<float> flip;  // flip_map; its mean is flip
};

struct MappedComparison {
  Comparison figures;
  DifferenceMaps maps;
};

// Refuses a picture without colour, or with values that are not finite.
Status check_comparable(const Image& picture);

// Both refuse that, too, and pictures of different sizes.
Result<Comparison> compare(const Image& picture, const Image& reference, const ComparisonSettings& settings = {});
Result<MappedComparison> compare_with_maps(const Image& picture, const Image& reference,
                                           const ComparisonSettings& settings = {});

}  // namespace luciole
