// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_range/clamped_range.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/isa.h"
#include "base/parallel.h"
#include "real_time/light_culling/tile.h"
#include "real_time/shading/predict_kernel.h"
#include "real_time/shading/shade_kernel.h"

namespace luciole {
namespace {

constexpr std::uint32_t kSampledGrids = 16;  // of up to 256 pixels each, spread evenly over the picture
constexpr int kBisections = 16;              // of log2(xi) over 32: xi to 0.04 %

// A tile of very coarse interleaving is a regular grid of pixels over the whole picture.
std::vector<PixelGroup> sample_groups(const GeometryBuffer& geometry) {
  const std::uint32_t step = (std::max(geometry.width, geometry.height) + kTileSide - 1) / kTileSide;
  std::vector<PixelGroup> groups;
  ScreenTile tile;
  for (std::uint32_t i = 0; i < kSampledGrids; ++i) {
    // Offsets of the plastic-number sequence: even in both directions for any number of grids.
    const double x = 0.7548776662466927 * (i + 1), y = 0.5698402909980532 * (i + 1);
    read_tile(geometry,
              {step, 0, 0, static_cast<std::uint32_t>((x - std::floor(x)) * step),
               static_cast<std::uint32_t>((y - std::floor(y)) * step)},
              tile);
    groups.insert(groups.end(), tile.groups.begin(), tile.groups.begin() + tile.group_count);
  }
  return groups;
}

// Emitters of all subsets side by side, with a xi of their own.
template <class Emitter>
class Trial {
 public:
  explicit Trial(const ReachingLights<Emitter>& lights) {
    for (std::size_t s = 0; s < lights.begin.size(); ++s) {
      const auto first = lights.emitters.begin() + lights.begin[s];
      emitters_.insert(emitters_.end(), first, first + lights.count[s]);
    }
    index_.resize(emitters_.size());
    std::iota(index_.begin(), index_.end(), 0u);
  }
  const Emitter* data() const { return emitters_.empty() ? nullptr : emitters_.data(); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(emitters_.size()); }
  void set_xi(float xi) {
    for (Emitter& emitter : emitters_) emitter.xi = xi;
  }
  double count_accepted(const PixelGroup& group, Isa isa) const {
    std::vector<std::uint16_t> lanes(emitters_.size());
    const LightList<Emitter> list{emitters_.data(), index_.data(), static_cast<std::uint32_t>(index_.size()), nullptr};
    LUCIOLE_FOR_ISA(isa, accepted_lanes(group, list, lanes.data()));
    const std::uint32_t used = (1u << group.count) - 1u;
    double count = 0;
    for (std::uint16_t bits : lanes) count += std::popcount(bits & used);
    return count;
  }

 private:
  AlignedVector<Emitter> emitters_;
  std::vector<std::uint32_t> index_;
};

class Sample {
 public:
  explicit Sample(const ShadingInputs& inputs)
      : isa_(inputs.settings.isa),
        groups_(sample_groups(inputs.geometry)),
        diffuse_(inputs.diffuse),
        glossy_(inputs.glossy),
        many_(inputs.many) {}

  // What stochastic ranges accept on average: the sum of p.
  double expected() const {
    return over_groups([&](const PixelGroup& group) {
      const SubsetLights lights{diffuse_.data(), glossy_.data(), std::max(diffuse_.size(), glossy_.size()),
                                many_.data(), many_.size()};
      alignas(64) const float albedo[3][kGroupPixels] = {};
      GroupPrediction prediction;
      LUCIOLE_FOR_ISA(isa_, predict_group(group, albedo, lights, prediction));
      return std::accumulate(prediction.accepted, prediction.accepted + group.count, 0.0);
    });
  }
  double accepted(float xi) {
    diffuse_.set_xi(xi), glossy_.set_xi(xi), many_.set_xi(xi);
    return over_groups([&](const PixelGroup& group) {
      return diffuse_.count_accepted(group, isa_) + glossy_.count_accepted(group, isa_) +
             many_.count_accepted(group, isa_);
    });
  }

 private:
  // Sums of integers, or in the order of the groups: the same for any number of threads.
  template <class Count>
  double over_groups(const Count& count) const {
    std::vector<double> counts(groups_.size());
    parallel_for(groups_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t g = begin; g < end && !stop_requested(); ++g) counts[g] = count(groups_[g]);
    });
    return std::accumulate(counts.begin(), counts.end(), 0.0);
  }

  Isa isa_;
  std::vector<PixelGroup> groups_;
  Trial<DiffuseEmitter> diffuse_;
  Trial<GlossyEmitter> glossy_;
  Trial<ManyEmitter> many_;
};

}  // namespace

float clamped_xi(const ShadingInputs& inputs) {
  Sample sample(inputs);
  const double target = sample.expected();
  float low = -32, high = 0;  // log2 of xi: fewer lights are accepted as it grows
  for (int i = 0; i < kBisections && !stop_requested(); ++i) {
    const float middle = 0.5f * (low + high);
    (sample.accepted(std::exp2(middle)) > target ? low : high) = middle;
  }
  return std::exp2(0.5f * (low + high));
}

}  // namespace luciole
