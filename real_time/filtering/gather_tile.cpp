// SPDX-License-Identifier: Apache-2.0
// Copies a tile and its apron next to each other: demodulated light and guides, with everything that must not
// contribute marked by a depth that no weight survives. After this the filter has no borders and no special pixels.
#include "equations/cpp/wide.h"
#include "real_time/filtering/filter_tile.h"

namespace luciole::LUCIOLE_ISA {
namespace {
#include "real_time/filtering/demodulation.h"

constexpr float kLargestFloat = 3.4028234663852886e38f;
constexpr float kFarAway = kLargestFloat;

LUCIOLE_FN real3 load3(const float* const (&planes)[3], std::size_t at) {
  return real3(load_unaligned(planes[0] + at), load_unaligned(planes[1] + at), load_unaligned(planes[2] + at));
}

LUCIOLE_FN void put(float* row, int quantity, int column, real value) {
  float* at = row + quantity * kFilterLine + column;
  __builtin_memcpy(at, &value.v, sizeof value.v);  // a store without alignment
}

void fill_outside(float* row, int begin, int end) {
  for (int quantity = 0; quantity < kFilterQuantities; ++quantity) {
    float* line = row + quantity * kFilterLine;
    for (int column = begin; column < end; ++column) line[column] = quantity == kInverseDepth ? kNoInverseDepth : 0.0f;
  }
}

LUCIOLE_FN void gather_pixels(const FilterPicture& picture, std::size_t at, float* row, int column) {
  const real depth = load_unaligned(picture.depth + at);
  real light[6];
  mask seen = depth <= kLargestFloat;
  for (int channel = 0; channel < 6; ++channel) {
    light[channel] = load_unaligned(picture.noisy[channel] + at);
    seen = seen && abs(light[channel]) <= kLargestFloat;
  }
  const real nothing(0.0f);
  const real3 normal = select(seen, load3(picture.normal, at), real3(nothing, nothing, nothing));
  put(row, kInverseDepth, column, select(seen, 1.0f / depth, real(kNoInverseDepth)));
  put(row, kNormalX, column, normal.x);
  put(row, kNormalY, column, normal.y);
  put(row, kNormalZ, column, normal.z);
  put(row, kAlpha, column, select(seen, load_unaligned(picture.ggx_alpha + at), nothing));
  const Demodulation d = demodulation(load3(picture.f0, at));
  const mask diffuse = seen && d.reflects_diffusely;
  put(row, kReflectsDiffusely, column, select(diffuse, real(1.0f), nothing));
  for (int channel = 0; channel < 3; ++channel) {
    put(row, kDiffuseR + channel, column, select(diffuse, light[channel] / d.diffuse, nothing));
  }
  put(row, kSpecularR, column, select(seen, light[3] / d.specular.x, nothing));
  put(row, kSpecularG, column, select(seen, light[4] / d.specular.y, nothing));
  put(row, kSpecularB, column, select(seen, light[5] / d.specular.z, nothing));
}

// Lowest value of each channel among the pixels that contribute; 0 without any.
void find_lowest(FilterTile& tile, int rows) {
  real lowest[6];
  for (real& value : lowest) value = real(kFarAway);
  for (int y = 0; y < rows; ++y) {
    const float* row = tile.scratch + y * kFilterRow;
    for (int x = 0; x < kFilterLine; x += kLanes) {
      const mask seen = load(row + kInverseDepth * kFilterLine + x) > 0.0f;
      const mask diffuse = load(row + kReflectsDiffusely * kFilterLine + x) > 0.0f;
      for (int channel = 0; channel < 6; ++channel) {
        const real value = load(row + (kDiffuseR + channel) * kFilterLine + x);
        lowest[channel] = min(lowest[channel], select(channel < 3 ? diffuse : seen, value, real(kFarAway)));
      }
    }
  }
  for (int channel = 0; channel < 6; ++channel) {
    alignas(64) float lanes[kLanes];
    store(lanes, lowest[channel]);
    float least = lanes[0];
    for (float value : lanes) least = value < least ? value : least;
    tile.lowest[channel] = least < kFarAway ? least : 0.0f;
  }
}

// Constant light becomes exactly 0, and so stays exactly constant through any weights. The lowest value is what is
// taken off because then nothing grows: a bright outlier could swamp its neighbours' digits.
void take_off_lowest(const FilterTile& tile, int rows) {
  for (int y = 0; y < rows; ++y) {
    float* row = tile.scratch + y * kFilterRow;
    for (int x = 0; x < kFilterLine; x += kLanes) {
      const real diffuse = load(row + kReflectsDiffusely * kFilterLine + x);
      for (int channel = 0; channel < 6; ++channel) {
        float* at = row + (kDiffuseR + channel) * kFilterLine + x;
        const real value = load(at) - tile.lowest[channel];
        store(at, channel < 3 ? value * diffuse : value);
      }
    }
  }
}

}  // namespace

void gather_tile(const FilterPicture& picture, FilterTile& tile) {
  const int left = tile.x - kLargestFilterRadius, top = tile.y - picture.radius.y;
  const int rows = tile.height + 2 * picture.radius.y;
  const int begin = left < 0 ? -left : 0;
  const int beyond = tile.width + 2 * kLargestFilterRadius;
  const int end = left + beyond > picture.width ? picture.width - left : beyond;
  for (int y = 0; y < rows; ++y) {
    float* row = tile.scratch + y * kFilterRow;
    if (top + y < 0 || top + y >= picture.height) {
      fill_outside(row, 0, kFilterLine);
      continue;
    }
    const std::size_t first = std::size_t(top + y) * std::size_t(picture.width) + std::size_t(left + begin);
    for (int x = begin; x < end; x += kLanes) gather_pixels(picture, first + std::size_t(x - begin), row, x);
    fill_outside(row, 0, begin);
    fill_outside(row, end, kFilterLine);
  }
  find_lowest(tile, rows);
  take_off_lowest(tile, rows);
}

}  // namespace luciole::LUCIOLE_ISA
