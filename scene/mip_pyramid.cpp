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

  void average(const MipImage::Level& source, const Taps& columns, const Taps& rows, std::uint8_t* target) const {
    Vec3 colour{0, 0, 0}, visible_colour{0, 0, 0};
    float alpha = 0;
    for (std::uint32_t j = 0; j < rows.count; ++j) {
      const std::uint8_t* texel = &source.rgba[(std::size_t(rows.first + j) * source.width + columns.first) * 4];
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

MipImage::Level halved(const MipImage::Level& source, const Averager& averager) {
  MipImage::Level level;
  level.width = std::max(source.width / 2, 1u);
  level.height = std::max(source.height / 2, 1u);
  level.rgba.resize(std::size_t(level.width) * level.height * 4);
  const std::vector<Taps> columns = halving_taps(source.width, level.width);
  const std::vector<Taps> rows = halving_taps(source.height, level.height);
  std::uint8_t* target = level.rgba.data();
  for (std::uint32_t y = 0; y < level.height; ++y) {
    for (std::uint32_t x = 0; x < level.width; ++x, target += 4) averager.average(source, columns[x], rows[y], target);
  }
  return level;
}

}  // namespace

MipImage build_mip_pyramid(DecodedImage image, bool srgb) {
  MipImage pyramid;
  pyramid.srgb = srgb;
  for (std::size_t i = 3; i < image.rgba.size() && !pyramid.has_alpha; i += 4) pyramid.has_alpha = image.rgba[i] != 255;
  pyramid.levels.push_back({image.width, image.height, std::move(image.rgba)});
  const Averager averager{srgb ? kLinearFromSrgb8 : kLinearFrom8, srgb, srgb && pyramid.has_alpha};
  while (pyramid.levels.back().width > 1 || pyramid.levels.back().height > 1) {
    pyramid.levels.push_back(halved(pyramid.levels.back(), averager));
  }
  return pyramid;
}

}  // namespace luciole
