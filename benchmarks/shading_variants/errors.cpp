// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/shading_variants/errors.h"

#include <algorithm>
#include <cmath>

#include "real_time/light_range/light_range.h"

namespace luciole {

DoubleReference::DoubleReference(const DeviceStage& stage, const VirtualPointLights& vpls, std::size_t most_pixels)
    : stage_(stage), right_(stage.geometry().pixel_count()) {
  const Settings& settings = stage.settings();
  GeometryBuffer some = stage.geometry();
  const std::size_t stride = (some.pixel_count() + most_pixels - 1) / std::max<std::size_t>(1, most_pixels);
  for (std::size_t i = 0; i < some.pixel_count(); ++i) {
    if (i % stride != 0) some.depth[i] = kNoSurface;
  }
  const RangeParameters range = range_parameters(settings, some.camera, {settings.seed, 0}, -1.0f);
  const auto diffuse = reach_diffuse_lobes(vpls, range, settings.interleave, settings.isa);
  const auto glossy = reach_glossy_lobes(vpls, range, settings.interleave, settings.isa);
  const std::uint32_t shift = stage.push(stage.kinds().front()).shift;
  if (stage.longest_subset(kDiffuseLights) > 0) test::add_lights(some, diffuse, settings.interleave, shift, right_);
  if (stage.longest_subset(kGlossyLights) > 0) test::add_lights(some, glossy, settings.interleave, shift, right_);
}

double DoubleReference::median_error(const std::vector<std::vector<PixelSums>>& sums) const {
  const GeometryBuffer& geometry = stage_.geometry();
  const double weight = double(stage_.settings().interleave) * stage_.settings().interleave;
  std::vector<double> errors;
  for (std::size_t i = 0; i < right_.size(); ++i) {
    if (right_[i].at_a_tie || right_[i].accepted == 0 || !(geometry.f0[1][i] > 0)) continue;
    double largest = 0, error = 0;
    std::uint32_t accepted = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double albedo = geometry.diffuse_albedo[c][i];
      const double right = right_[i].light[c] * albedo + right_[i].light[c + 3];
      double found = 0;
      for (std::size_t k = 0; k < sums.size() && stage_.kinds()[k] != kManyLights; ++k) {
        found += weight * (double(sums[k][i].diffuse[c]) * albedo + sums[k][i].specular[c]);
        if (c == 0) accepted += sums[k][i].accepted;
      }
      largest = std::max(largest, right), error = std::max(error, std::abs(found - right));
    }
    if (largest > 0 && accepted == right_[i].accepted) errors.push_back(error / largest);
  }
  if (errors.empty()) return 0;
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

}  // namespace luciole
