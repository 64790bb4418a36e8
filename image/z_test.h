// SPDX-License-Identifier: Apache-2.0
// Is the mean of many frames the reference? The image z-test: every pixel's deviation in units of its own, predicted
// standard deviation.
#pragma once
#include <cstdint>
#include <string>

#include "image/estimator_statistics.h"

namespace luciole {

// The limits of the verdict.
struct ZTestLimits {
  double family_error = 0.01;   // chance that a right estimator leaves the Sidak limit anywhere, were all normal
  double share_outside = 1e-4;  // of all values may lie beyond it
  double hard_limit = 8;        // [standard deviations] none may lie beyond
  double picture_limit = 3.3;   // |t| of the picture's mean luminance, frames as units
  double lowest_variance_ratio = 0.85, highest_variance_ratio = 1.15;  // sampled / predicted, mean over values
};

struct ZTestReport {
  bool passed = false;
  std::string reason;         // one sentence; empty if passed
  std::uint64_t values = 0;   // tested: three channels of single pixels and of blocks
  std::uint64_t outside = 0;  // beyond sidak_limit
  std::uint64_t single_pixels = 0, blocks = 0, untested_pixels = 0;  // untested: too dark even all together
  double sidak_limit = 0;                                            // [standard deviations]
  double largest_deviation = 0;                                      // |z| of the worst value
  std::uint64_t worst_pixel = 0;  // its index, or that of the upper left pixel of its block
  double picture_t = 0;
  double variance_ratio = 1;          // 1 where there is no variance
  std::uint64_t variance_values = 0;  // how many values it is the mean of
};

// Per channel and pixel z = (mean - reference) / sqrt(predicted variance / frames + (2^-20 reference)^2); the second
// term is the rounding of float sums, which does not shrink with frames. Dark pixels (EstimatorStatistics) enter as
// blocks, with the variance that the frames show. A block is used if kEnoughAccepted lights are expected in it and the
// frames' fourth moment agrees that so many independent events were seen; otherwise its dark pixels go to the next
// larger one. All frames that were planned must have been added.
ZTestReport image_z_test(const EstimatorStatistics& statistics, const ZTestLimits& limits = {});

// z > 0 with P(|Z| > z) = tail for a standard normal Z; 0 < tail <= 1.
double two_sided_normal_quantile(double tail);

// The deviation that the largest of `values` independent standard normals exceeds with chance `family_error`.
// Z. Sidak, "Rectangular confidence regions for the means of multivariate normal distributions", JASA 1967.
double sidak_limit(std::uint64_t values, double family_error);

}  // namespace luciole
