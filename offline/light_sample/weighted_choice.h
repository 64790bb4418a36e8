// SPDX-License-Identifier: Apache-2.0
// One of many lights, with a probability proportional to its weight, while the lights still come in: a weighted
// reservoir of one, that takes a chunk at a time and uses one random number in all.   [Chao 1982]
#pragma once
#include <array>
#include <cstdint>

#include "offline/light_sample/light_sampler.h"

namespace luciole {

struct Weighing {
  Weight weight = Weight::reflected;
  float radiance_floor = 0;
  Isa isa = Isa::baseline;  // resolved
};

// Calls use(lights, tints, weights, count) for all lights of the rows, a chunk at a time.
template <class Use>
void weigh_in_chunks(const LightRows& rows, const Receiver& receiver, const Weighing& how, const Use& use) {
  constexpr std::uint32_t kChunk = 256;
  alignas(64) float weights[kChunk];
  for (std::uint32_t first = 0; first < rows.size(); first += kChunk) {
    const LightRowsView view = rows.view(first, rows.size() - first < kChunk ? rows.size() - first : kChunk);
    LUCIOLE_FOR_ISA(how.isa, weigh_lights(view, receiver, how.weight, how.radiance_floor, weights));
    use(rows.lights() + first, rows.tints() + first, weights, view.count);
  }
}

// The weight of one light, the same bits as among others.
//   xi  of the light's range; 0: in reach from everywhere
inline float weight_of(const LightRecord& light, float xi, const Receiver& receiver, const Weighing& how) {
  alignas(64) float rows[LightRowsView::kRows][kBlockLights] = {};
  alignas(64) float weights[kBlockLights];
  const LightRowValues values = row_values(light, xi);
  LightRowsView view;
  view.count = 1;
  for (std::size_t r = 0; r < values.size(); ++r) rows[r][0] = values[r], view.row[r] = rows[r];
  LUCIOLE_FOR_ISA(how.isa, weigh_lights(view, receiver, how.weight, how.radiance_floor, weights));
  return weights[0];
}

class WeightedChoice {
 public:
  explicit WeightedChoice(double u) : u_(u) {}

  void add(const LightRows& rows, const Receiver& receiver, const Weighing& how) {
    weigh_in_chunks(rows, receiver, how,
                    [this](const std::uint32_t* lights, const Vec3* tints, const float* weights, std::uint32_t count) {
                      Vec3 colour{0, 0, 0};
                      for (std::uint32_t k = 0; k < count; ++k) colour += tints[k] * weights[k];
                      // As the weights: a chunk in single precision, the sum over chunks in double. What rounding
                      // takes from the sum of very many lights would be missing from their mean.
                      colour_[0] += colour.x, colour_[1] += colour.y, colour_[2] += colour.z;
                      add(lights, tints, weights, count);
                    });
  }

  // tints: none for lists, whose lights then count as white.
  void add(const std::uint32_t* lights, const Vec3* tints, const float* weights, std::uint32_t count) {
    float chunk = 0;
    for (std::uint32_t k = 0; k < count; ++k) chunk += weights[k];
    weighed_ += count;
    if (!(chunk > 0)) return;
    total_ += chunk;
    // The number that decided is stretched to (0,1) again, for what comes next.
    const double share = double(chunk) / total_;
    if (u_ >= share) {
      u_ = (u_ - share) / (1 - share);
      return;
    }
    u_ /= share;
    double wanted = u_ * chunk;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!(weights[k] > 0)) continue;
      light_ = lights[k], weight_ = weights[k];  // the last one with weight, should rounding run past the end
      if (tints != nullptr) tint_ = tints[k];
      if (wanted < weights[k]) break;
      wanted -= weights[k];
    }
    u_ = wanted / weight_ < 1 ? wanted / weight_ : 0.5;
  }

  float total() const { return static_cast<float>(total_); }
  ChosenLight chosen() const {
    if (light_ == kNoLight) return {kNoLight, 0, weighed_};
    const auto apart = [this](double sum, float tint) { return static_cast<float>(sum - tint * total_); };
    return {light_, static_cast<float>(weight_ / total_), weighed_,
            Vec3{apart(colour_[0], tint_.x), apart(colour_[1], tint_.y), apart(colour_[2], tint_.z)}};
  }

 private:
  double u_, total_ = 0;
  std::uint32_t light_ = kNoLight, weighed_ = 0;
  float weight_ = 0;
  std::array<double, 3> colour_{};  // sum of tints by weight
  Vec3 tint_{0, 0, 0};              // of the chosen one
};

}  // namespace luciole
