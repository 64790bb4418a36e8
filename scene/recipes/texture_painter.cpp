// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/texture_painter.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "scene/mip_pyramid.h"
#include "scene/recipes/hash.h"
#include "scene/srgb.h"

namespace luciole::workshop {
namespace {

std::uint8_t encode(float x, Encoding encoding) {
  x = std::clamp(x, 0.0f, 1.0f);
  return encoding == Encoding::srgb ? srgb8_from_linear(x) : static_cast<std::uint8_t>(std::lround(255 * x));
}

// Smooth, with zero slope and curvature at both ends.
float fade(float t) { return t * t * t * (t * (6 * t - 15) + 10); }

float lattice(std::uint32_t x, std::uint32_t y, std::uint32_t period, std::uint32_t seed) {
  const std::uint32_t bits = mix_bits(seed * 0x9e3779b9u + (y % period) * period + x % period);
  return static_cast<float>(bits >> 8) * 0x1p-23f - 1;
}

}  // namespace

Texture paint(const std::string& name, std::uint32_t size, Encoding encoding, const PaintColour& colour) {
  DecodedImage image{size, size, AlignedVector<std::uint8_t>(std::size_t(4) * size * size, 255)};
  parallel_for(size, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < size; ++x) {
        const float scale = 1.0f / static_cast<float>(size);
        const Vec3 c = colour({(static_cast<float>(x) + 0.5f) * scale, (static_cast<float>(y) + 0.5f) * scale});
        std::uint8_t* texel = &image.rgba[4 * (y * size + x)];
        texel[0] = encode(c.x, encoding), texel[1] = encode(c.y, encoding), texel[2] = encode(c.z, encoding);
      }
    }
  });
  Texture texture;
  texture.name = name;
  texture.image = std::make_shared<const MipImage>(build_mip_pyramid(image, encoding == Encoding::srgb));
  return texture;
}

Texture paint_normals(const std::string& name, std::uint32_t size, float metres, const PaintHeight& height) {
  const float scale = 1.0f / static_cast<float>(size);
  std::vector<float> heights(std::size_t(size) * size);
  parallel_for(size, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * size; k < end * size; ++k) {
      heights[k] =
          height({(static_cast<float>(k % size) + 0.5f) * scale, (static_cast<float>(k / size) + 0.5f) * scale});
    }
  });
  return paint(name, size, Encoding::linear, [&](Vec2 at) {
    const auto x = static_cast<std::size_t>(at.x * static_cast<float>(size));
    const auto y = static_cast<std::size_t>(at.y * static_cast<float>(size));
    const float across = heights[y * size + (x + 1) % size] - heights[y * size + (x + size - 1) % size];
    const float down = heights[(y + 1) % size * size + x] - heights[(y + size - 1) % size * size + x];
    // glTF: x along +u, y up the picture, against +v.
    const Vec3 normal = normalize(Vec3{-across, down, 2 * scale * metres});
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
