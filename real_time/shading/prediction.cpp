// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/prediction.h"

#include <algorithm>

#include "base/isa.h"
#include "base/parallel.h"
#include "real_time/light_culling/tile.h"
#include "real_time/shading/predict_kernel.h"

namespace luciole {
namespace {

template <class Emitter>
const Emitter* subset_emitters(const ReachingLights<Emitter>& lights, std::uint32_t subset) {
  return lights.emitters.empty() ? nullptr : lights.emitters.data() + lights.begin[subset];
}
template <class Emitter>
std::uint32_t subset_count(const ReachingLights<Emitter>& lights, std::uint32_t subset) {
  return lights.emitters.empty() ? 0 : lights.count[subset];
}

// The estimate is n^2 times the sum over a uniformly chosen subset k. With S_k the subset's exact sum and V_k the
// variance of its roulette, its mean is sum S_k, and its variance n^2 sum V_k + n^2 sum S_k^2 - (sum S_k)^2.
struct PixelMoments {
  double sum[3] = {}, sum_sq[3] = {}, variance[3] = {}, accepted = 0;
};

void add(const GroupPrediction& subset, std::uint32_t lane, PixelMoments& moments) {
  for (int c = 0; c < 3; ++c) {
    const double s = subset.sum[c][lane];
    moments.sum[c] += s;
    moments.sum_sq[c] += s * s;
    moments.variance[c] += subset.variance[c][lane];
  }
  moments.accepted += subset.accepted[lane];
}

void write(const PixelMoments& moments, double subsets, std::uint32_t pixel, Prediction& out) {
  for (int c = 0; c < 3; ++c) {
    const double between = subsets * moments.sum_sq[c] - moments.sum[c] * moments.sum[c];
    out.reference[c][pixel] = static_cast<float>(moments.sum[c]);
    out.variance[c][pixel] = static_cast<float>(subsets * moments.variance[c] + std::max(between, 0.0));
  }
  out.accepted[pixel] = static_cast<float>(moments.accepted / subsets);
}

void predict_pixels(const ShadingInputs& inputs, const PixelGroup& group, Prediction& out) {
  const std::uint32_t subsets = inputs.settings.interleave * inputs.settings.interleave;
  alignas(64) float albedo[3][kGroupPixels];
  for (int c = 0; c < 3; ++c)
    for (int lane = 0; lane < kGroupPixels; ++lane)
      albedo[c][lane] = inputs.geometry.diffuse_albedo[c][group.pixel[lane]];
  PixelMoments moments[kGroupPixels];
  for (std::uint32_t k = 0; k < subsets; ++k) {
    const std::uint32_t diffuse = subset_count(inputs.diffuse, k), glossy = subset_count(inputs.glossy, k);
    const SubsetLights lights{diffuse > 0 ? subset_emitters(inputs.diffuse, k) : nullptr,
                              glossy > 0 ? subset_emitters(inputs.glossy, k) : nullptr, std::max(diffuse, glossy),
                              subset_emitters(inputs.many, k), subset_count(inputs.many, k)};
    GroupPrediction subset;
    LUCIOLE_FOR_ISA(inputs.settings.isa, predict_group(group, albedo, lights, subset));
    for (std::uint32_t lane = 0; lane < group.count; ++lane) add(subset, lane, moments[lane]);
  }
  for (std::uint32_t lane = 0; lane < group.count; ++lane)
    write(moments[lane], static_cast<double>(subsets), group.pixel[lane], out);
}

}  // namespace

Prediction predict(const ShadingInputs& inputs) {
  Prediction out;
  const std::size_t pixels = inputs.geometry.pixel_count();
  for (Plane3* planes : {&out.reference, &out.variance})
    for (Plane& plane : *planes) plane.assign(pixels, 0.0f);
  out.accepted.assign(pixels, 0.0f);
  const std::uint32_t tiles_x = (inputs.geometry.width + kTileSide - 1) / kTileSide;
  const std::uint32_t tiles_y = (inputs.geometry.height + kTileSide - 1) / kTileSide;
  parallel_for(std::size_t(tiles_x) * tiles_y, 1, [&](std::size_t begin, std::size_t end) {
    ScreenTile tile;
    for (std::size_t i = begin; i < end && !stop_requested(); ++i) {
      read_tile(inputs.geometry,
                {1, static_cast<std::uint32_t>(i % tiles_x), static_cast<std::uint32_t>(i / tiles_x), 0, 0}, tile);
      for (std::uint32_t g = 0; g < tile.group_count; ++g) predict_pixels(inputs, tile.groups[g], out);
    }
  });
  return out;
}

}  // namespace luciole
