// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/texture_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "scene/recipes/hash.h"

namespace luciole::workshop {
namespace {

float srgb_from_linear(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }
float linear_from_srgb(float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); }

std::uint8_t byte_of(float x) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0f, 1.0f))); }

const std::array<float, 256>& decoded_srgb() {
  static const auto table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear_from_srgb(static_cast<float>(i) / 255);
    return values;
  }();
  return table;
}

std::uint8_t encode(float x, Encoding encoding) {
  return byte_of(encoding == Encoding::srgb ? srgb_from_linear(std::clamp(x, 0.0f, 1.0f)) : x);
}

float decode(std::uint8_t x, Encoding encoding) {
  return encoding == Encoding::srgb ? decoded_srgb()[x] : static_cast<float>(x) / 255;
}

// The next mip level: the mean of 2 x 2 texels in linear light. Sides are powers of two.
MipImage::Level halved(const MipImage::Level& fine, Encoding encoding) {
  MipImage::Level coarse{fine.width / 2, fine.height / 2, {}};
  coarse.rgba.resize(std::size_t(4) * coarse.width * coarse.height);
  for (std::uint32_t y = 0; y < coarse.height; ++y) {
    for (std::uint32_t x = 0; x < coarse.width; ++x) {
      const std::size_t row = std::size_t(4) * fine.width, from = 2 * y * row + std::size_t(8) * x;
      for (std::size_t c = 0; c < 4; ++c) {
        float sum = 0;
        for (const std::size_t texel : {from, from + 4, from + row, from + row + 4}) {
          sum += decode(fine.rgba[texel + c], c < 3 ? encoding : Encoding::linear);
        }
        coarse.rgba[4 * (std::size_t(coarse.width) * y + x) + c] =
            encode(sum / 4, c < 3 ? encoding : Encoding::linear);
      }
    }
  }
  return coarse;
}

// Smooth, with zero slope and curvature at both ends.
float fade(float t) { return t * t * t * (t * (6 * t - 15) + 10); }

float lattice(std::uint32_t x, std::uint32_t y, std::uint32_t period, std::uint32_t seed) {
  return 2 * unit_hash(seed, (y % period) * period + x % period, 7) - 1;
}

}  // namespace

Texture paint(const std::string& name, std::uint32_t size, Encoding encoding, const PaintColour& colour) {
  auto image = std::make_shared<MipImage>();
  image->srgb = encoding == Encoding::srgb;
  MipImage::Level level{size, size, {}};
  level.rgba.resize(std::size_t(4) * size * size);
  parallel_for(size, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < size; ++x) {
        const float scale = 1.0f / static_cast<float>(size);
        const Vec3 c = colour({(static_cast<float>(x) + 0.5f) * scale, (static_cast<float>(y) + 0.5f) * scale});
        std::uint8_t* texel = &level.rgba[4 * (y * size + x)];
        texel[0] = encode(c.x, encoding), texel[1] = encode(c.y, encoding), texel[2] = encode(c.z, encoding);
        texel[3] = 255;
      }
    }
  });
  image->levels.push_back(std::move(level));
  while (image->levels.back().width > 1) image->levels.push_back(halved(image->levels.back(), encoding));
  Texture texture;
  texture.name = name;
  texture.image = std::move(image);
  return texture;
}

Texture paint_normals(const std::string& name, std::uint32_t size, float metres, const PaintHeight& height) {
  const float step = 0.5f / static_cast<float>(size);
  return paint(name, size, Encoding::linear, [&](Vec2 at) {
    const auto wrapped = [](float x) { return x - std::floor(x); };
    const float across = height({wrapped(at.x + step), at.y}) - height({wrapped(at.x - step), at.y});
    const float down = height({at.x, wrapped(at.y + step)}) - height({at.x, wrapped(at.y - step)});
    // glTF: x along +u, y along -v in image space, that is upwards in the picture.
    const Vec3 normal = normalize(Vec3{-across, down, 2 * step * metres});
    return normal * 0.5f + Vec3{0.5f, 0.5f, 0.5f};
  });
}

float tiling_noise(Vec2 place, std::uint32_t period, std::uint32_t seed) {
  const float x = place.x * static_cast<float>(period), y = place.y * static_cast<float>(period);
  const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
  const float s = fade(x - static_cast<float>(i)), t = fade(y - static_cast<float>(j));
  const float top = std::lerp(lattice(i, j, period, seed), lattice(i + 1, j, period, seed), s);
  const float bottom = std::lerp(lattice(i, j + 1, period, seed), lattice(i + 1, j + 1, period, seed), s);
  return std::lerp(top, bottom, t);
}

float tiling_fractal(Vec2 place, std::uint32_t period, std::uint32_t octaves, std::uint32_t seed) {
  float sum = 0, strength = 0.5f;
  for (std::uint32_t octave = 0; octave < octaves; ++octave) {
    sum += strength * tiling_noise(place, period << octave, seed + octave);
    strength *= 0.5f;
  }
  return sum;
}

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

Vec3 blend(Vec3 a, Vec3 b, float t) { return a + (b - a) * t; }

}  // namespace luciole::workshop
