// SPDX-License-Identifier: Apache-2.0
// The cross bilateral filter over a gathered tile: lanes are pixels side by side. Per tap 14 operations of weight and 8
// of accumulation against 12 loads, which take two slots each because nearly all straddle two cache lines: 11 cycles of
// arithmetic beside 12 of loading. Sharing the loads between two rows of pixels is no faster
// (docs/decisions/filter.md).
#include "real_time/filtering/filter_tile.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
namespace {
#include "real_time/filtering/bilateral_weight.h"
#include "real_time/filtering/demodulation.h"

// Weighted light of some pixels side by side.
struct Sums {
  real diffuse_weight, specular_weight;
  real light[6];
};

LUCIOLE_FN real3 load3(const float* const (&planes)[3], std::size_t at) {
  return real3(load_unaligned(planes[0] + at), load_unaligned(planes[1] + at), load_unaligned(planes[2] + at));
}
LUCIOLE_FN real3 broadcast3(const float (&v)[3]) { return real3(real(v[0]), real(v[1]), real(v[2])); }

LUCIOLE_FN real lane_numbers() {
  alignas(64) static constexpr float kNumbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  return load(kNumbers);
}

LUCIOLE_FN FilterCentre centre_at(const FilterPicture& picture, int x, int y) {
  const std::size_t at = std::size_t(y) * std::size_t(picture.width) + std::size_t(x);
  const real3 right = broadcast3(picture.right), up = broadcast3(picture.up);
  const real across = (lane_numbers() + (static_cast<float>(x) + picture.left_edge)) * picture.footprint;
  const float below = (static_cast<float>(y) + picture.top_edge) * picture.footprint;
  const real3 ray = broadcast3(picture.forward) + right * across - up * real(below);
  return filter_centre(load3(picture.normal, at), load3(picture.geometric_normal, at),
                       load_unaligned(picture.ggx_alpha + at), load_unaligned(picture.depth + at), ray, right, up,
                       real(picture.footprint));
}

// A tap `right` pixels to the right of the centres; `tap` is its first quantity. kScaled: weights times `scale`.
template <bool kScaled>
LUCIOLE_FN void add_tap(const float* tap, real right, const FilterCentre& centre, real row_offset, real scale,
                        Sums& sums) {
  const auto quantity = [tap](int which) __attribute__((always_inline)) {
    return load_unaligned(tap + which * kFilterLine);
  };
  const real3 normal(quantity(kNormalX), quantity(kNormalY), quantity(kNormalZ));
  TapWeight w = tap_weight(centre, row_offset, right, quantity(kInverseDepth), normal, quantity(kAlpha));
  if constexpr (kScaled) w.diffuse *= scale, w.specular *= scale;
  sums.diffuse_weight += w.diffuse * quantity(kReflectsDiffusely);
  sums.specular_weight += w.specular;
  for (int channel = 0; channel < 6; ++channel) {
    sums.light[channel] += (channel < 3 ? w.diffuse : w.specular) * quantity(kDiffuseR + channel);
  }
}

// The taps of one row of the tile, of weight `scale`; `tap` is the one in the centres' column.
template <bool kScaled>
LUCIOLE_FN void add_row(const float* tap, int radius, const FilterCentre& centre, real row_offset, float scale,
                        Sums& sums) {
  const int inner = radius > 0 ? radius - 1 : 0;
  if (radius > 0) {
    const real end(static_cast<float>(radius));
    add_tap<true>(tap - radius, -end, centre, row_offset, real(0.5f * scale), sums);
    add_tap<true>(tap + radius, end, centre, row_offset, real(0.5f * scale), sums);
  }
  // Counted in a register: a number made from x would cost three operations on the ports that are the bound.
  real right(static_cast<float>(-inner));
  for (int x = -inner; x <= inner; ++x, right += real(1.0f)) {
    add_tap<kScaled>(tap + x, right, centre, row_offset, real(scale), sums);
  }
}

// All taps of the pixels from (x, y) of the tile.
LUCIOLE_FN Sums add_taps(const FilterRadius& radius, const FilterTile& tile, int x, int y, const FilterCentre& centre) {
  Sums sums;
  for (int down = -radius.y; down <= radius.y; ++down) {
    const float* tap = tile.scratch + (y + radius.y + down) * kFilterRow + kLargestFilterRadius + x;
    const real row_offset = plane_offset_of_row(centre, real(static_cast<float>(down)));
    if (radius.y > 0 && (down == -radius.y || down == radius.y)) {
      add_row<true>(tap, radius.x, centre, row_offset, 0.5f, sums);
    } else {
      add_row<false>(tap, radius.x, centre, row_offset, 1.0f, sums);
    }
  }
  return sums;
}

// Stores the first `count` lanes.
LUCIOLE_FN void store_lanes(float* at, real value, int count) {
  if (count >= kLanes) {
    __builtin_memcpy(at, &value.v, sizeof value.v);
    return;
  }
  alignas(64) float lanes[kLanes];
  store(lanes, value);
  for (int lane = 0; lane < count; ++lane) at[lane] = lanes[lane];
}

// Means from sums, modulated again. The sky keeps what it has, and so does a pixel that nothing is like.
LUCIOLE_FN void finish(const FilterPicture& picture, const FilterTile& tile, int x, int y, const Sums& sums) {
  const std::size_t at = std::size_t(tile.y + y) * std::size_t(picture.width) + std::size_t(tile.x + x);
  const mask surface = load_unaligned(picture.depth + at) <= 3.4028234663852886e38f;
  const Demodulation d = demodulation(load3(picture.f0, at));
  const real modulation[6] = {d.diffuse, d.diffuse, d.diffuse, d.specular.x, d.specular.y, d.specular.z};
  for (int channel = 0; channel < 6; ++channel) {
    const real weight = channel < 3 ? sums.diffuse_weight : sums.specular_weight;
    const real mean = sums.light[channel] / weight + tile.lowest[channel];
    const real own = load_unaligned(picture.noisy[channel] + at);
    store_lanes(picture.clean[channel] + at, select(surface && weight > 0.0f, mean * modulation[channel], own),
                tile.width - x);
  }
}

}  // namespace

void filter_tile(const FilterPicture& picture, const FilterTile& tile) {
  for (int x = 0; x < tile.width; x += kLanes) {
    for (int y = 0; y < tile.height; ++y) {
      const FilterCentre centre = centre_at(picture, tile.x + x, tile.y + y);
      finish(picture, tile, x, y, add_taps(picture.radius, tile, x, y, centre));
    }
  }
}

}  // namespace luciole::LUCIOLE_ISA
