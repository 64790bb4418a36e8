// SPDX-License-Identifier: Apache-2.0
#include "scene/mip_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/srgb.h"

namespace luciole {
namespace {

// Which source texels make one target texel along one axis, and how much of each. Halving a side n needs at most three.
struct Taps {
  std::uint32_t first = 0, count = 1;
  std::array<float, 3> weight{1, 0, 0};  // sum 1
};

std::vector<Taps> halving_taps(std::uint32_t source, std::uint32_t target) {
  std::vector<Taps> taps(target);
  if (source == target) {
    for (std::uint32_t i = 0; i < target; ++i) taps[i].first = i;
    return taps;
  }
  const double ratio = static_cast<double>(source) / target;
  for (std::uint32_t i = 0; i < target; ++i) {
    const double begin = i * ratio, end = (i + 1) * ratio;
    Taps& tap = taps[i];
    tap.first = static_cast<std::uint32_t>(begin);
    const auto last = std::min(static_cast<std::uint32_t>(std::ceil(end - 1e-9)), source);
    tap.count = std::min<std::uint32_t>(last - tap.first, 3);
    for (std::uint32_t k = 0; k < tap.count; ++k) {
      const double low = std::max<double>(tap.first + k, begin), high = std::min<double>(tap.first + k + 1.0, end);
      tap.weight[k] = static_cast<float>((high - low) / ratio);
    }
  }
  return taps;
}

std::uint8_t linear8(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

struct Averager {
  const std::array<float, 256>& decode;
  bool srgb, weigh_by_alpha;

  // source: texels of a level, `width` per row
  void average(const std::uint8_t* source, std::uint32_t width, const Taps& columns, const Taps& rows,
               std::uint8_t* target) const {
    Vec3 colour{0, 0, 0}, visible_colour{0, 0, 0};
    float alpha = 0;
    for (std::uint32_t j = 0; j < rows.count; ++j) {
      const std::uint8_t* texel = source + (std::size_t(rows.first + j) * width + columns.first) * 4;
      for (std::uint32_t i = 0; i < columns.count; ++i, texel += 4) {
        const float weight = rows.weight[j] * columns.weight[i];
        const float texel_alpha = kLinearFrom8[texel[3]];
        const Vec3 value(decode[texel[0]], decode[texel[1]], decode[texel[2]]);
        colour += value * weight;
        visible_colour += value * (weight * texel_alpha);
        alpha += weight * texel_alpha;
      }
    }
    if (weigh_by_alpha && alpha > 0) colour = visible_colour / alpha;
    target[0] = encode(colour.x);
    target[1] = encode(colour.y);
    target[2] = encode(colour.z);
    target[3] = linear8(alpha);
  }

  std::uint8_t encode(float value) const { return srgb ? srgb8_from_linear(value) : linear8(value); }
};

// Sizes and places of all levels; returns how many texels they have together.
std::size_t place_levels(std::uint32_t width, std::uint32_t height, std::vector<MipImage::Level>& levels) {
  std::size_t texels = 0;
  for (;; width = std::max(width / 2, 1u), height = std::max(height / 2, 1u)) {
    levels.push_back({width, height, static_cast<std::uint32_t>(texels)});
    texels += std::size_t(width) * height;
    if (width == 1 && height == 1) return texels;
  }
}

void halve(const MipImage::Level& source, const MipImage::Level& half, const Averager& averager, std::uint8_t* rgba) {
  const std::vector<Taps> columns = halving_taps(source.width, half.width);
  const std::vector<Taps> rows = halving_taps(source.height, half.height);
  const std::uint8_t* from = rgba + std::size_t(source.first_texel) * 4;
  std::uint8_t* target = rgba + std::size_t(half.first_texel) * 4;
  for (std::uint32_t y = 0; y < half.height; ++y) {
    for (std::uint32_t x = 0; x < half.width; ++x, target += 4) {
      averager.average(from, source.width, columns[x], rows[y], target);
    }
  }
}

}  // namespace

MipImage build_mip_pyramid(const DecodedImage& image, bool srgb) {
  MipImage pyramid;
  pyramid.srgb = srgb;
  for (std::size_t i = 3; i < image.rgba.size() && !pyramid.has_alpha; i += 4) pyramid.has_alpha = image.rgba[i] != 255;
  const std::size_t texels = place_levels(image.width, image.height, pyramid.levels);
  pyramid.rgba.reserve(texels * 4);
  pyramid.rgba = image.rgba;
  pyramid.rgba.resize(texels * 4);
  const Averager averager{srgb ? kLinearFromSrgb8 : kLinearFrom8, srgb, srgb && pyramid.has_alpha};
  for (std::size_t i = 1; i < pyramid.levels.size(); ++i) {
    halve(pyramid.levels[i - 1], pyramid.levels[i], averager, pyramid.rgba.data());
  }
  return pyramid;
}

}  // namespace luciole
