// SPDX-License-Identifier: Apache-2.0
// Texture look-ups with explicit level of detail (equations/texture_level_of_detail.h). Called several times per hit:
// plain functions on values, single precision.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scene/scene.h"
#include "scene/srgb.h"

namespace luciole {

namespace texture_detail {

// Texel number of an unwrapped coordinate; `size` texels.
inline std::int32_t wrapped(std::int32_t i, std::int32_t size, Wrap wrap) {
  if (wrap == Wrap::clamp_to_edge) return std::clamp(i, 0, size - 1);
  if (wrap == Wrap::repeat) {
    // The coordinate was reduced to [0, 1) before: only the neighbours of the border are left.
    if (i < 0) return i + size;
    return i >= size ? i - size : i;
  }
  // Mirrored, reduced to [0, 2): texels size..2*size-1 run backwards.
  if (i < 0) return 0;  // -1 mirrors to 0
  if (i >= 2 * size) return 0;
  return i >= size ? 2 * size - 1 - i : i;
}

// Reduces a coordinate so that it fits an integer, whatever it was; not-a-number becomes 0.
inline float reduced(float u, Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      u -= std::floor(u);
      break;
    case Wrap::mirrored_repeat:
      u -= 2.0f * std::floor(u * 0.5f);
      break;
    case Wrap::clamp_to_edge:
      u = std::clamp(u, 0.0f, 1.0f);
      break;
  }
  return u >= 0.0f && u <= 2.0f ? u : 0.0f;
}

inline const std::uint8_t* texel(const MipImage& image, const MipImage::Level& level, std::int32_t x, std::int32_t y) {
  return image.texels(level) + (static_cast<std::size_t>(y) * level.width + static_cast<std::size_t>(x)) * 4;
}

inline Vec4 decoded(const std::uint8_t* rgba, const std::array<float, 256>& colour) {
  return {colour[rgba[0]], colour[rgba[1]], colour[rgba[2]], kLinearFrom8[rgba[3]]};
}

// Where a look-up falls in one level: the two columns and rows and how far between them. Nearest look-ups have x0 ==
// x1.
struct Footprint {
  std::int32_t x0, x1, y0, y1;
  float fx, fy;
};

inline Footprint footprint(const Texture& texture, const MipImage::Level& level, Vec2 uv, bool linear) {
  const auto width = static_cast<std::int32_t>(level.width), height = static_cast<std::int32_t>(level.height);
  const float x = uv.x * static_cast<float>(width), y = uv.y * static_cast<float>(height);
  if (!linear) {
    const auto i = wrapped(static_cast<std::int32_t>(x), width, texture.wrap_u);
    const auto j = wrapped(static_cast<std::int32_t>(y), height, texture.wrap_v);
    return {i, i, j, j, 0, 0};
  }
  // Texel centres lie at +0.5. The conversion truncates; x + 0.5 is positive.
  const auto i = static_cast<std::int32_t>(x + 0.5f) - 1, j = static_cast<std::int32_t>(y + 0.5f) - 1;
  return {wrapped(i, width, texture.wrap_u),  wrapped(i + 1, width, texture.wrap_u),
          wrapped(j, height, texture.wrap_v), wrapped(j + 1, height, texture.wrap_v),
          x - 0.5f - static_cast<float>(i),   y - 0.5f - static_cast<float>(j)};
}

inline Vec4 sample_level(const Texture& texture, const MipImage::Level& level, Vec2 uv, bool linear) {
  const MipImage& image = *texture.image;
  const std::array<float, 256>& colour = image.srgb ? kLinearFromSrgb8 : kLinearFrom8;
  const Footprint f = footprint(texture, level, uv, linear);
  if (!linear) return decoded(texel(image, level, f.x0, f.y0), colour);
  const float w00 = (1 - f.fx) * (1 - f.fy), w10 = f.fx * (1 - f.fy), w01 = (1 - f.fx) * f.fy, w11 = f.fx * f.fy;
  return decoded(texel(image, level, f.x0, f.y0), colour) * w00 +
         decoded(texel(image, level, f.x1, f.y0), colour) * w10 +
         decoded(texel(image, level, f.x0, f.y1), colour) * w01 +
         decoded(texel(image, level, f.x1, f.y1), colour) * w11;
}

}  // namespace texture_detail

// The texture's value, linear (sRGB decoded), each channel in [0,1].
//   uv   after the slot's transform; (0,0) is the corner of the top left texel
//   lod  see texture_level_of_detail; 0 or less looks at the finest level with the magnification filter
inline Vec4 sample_texture(const Texture& texture, Vec2 uv, float lod) {
  using namespace texture_detail;
  const MipImage& image = *texture.image;
  const Vec2 at(reduced(uv.x, texture.wrap_u), reduced(uv.y, texture.wrap_v));
  if (!(lod > 0)) return sample_level(texture, image.levels[0], at, texture.magnify_linear);
  const bool linear = texture.minify_linear;
  if (texture.mip_filter == MipFilter::none) return sample_level(texture, image.levels[0], at, linear);
  const auto coarsest = static_cast<std::uint32_t>(image.levels.size() - 1);
  const float level = std::min(lod, static_cast<float>(coarsest));
  if (texture.mip_filter == MipFilter::nearest) {
    return sample_level(texture, image.levels[std::min(static_cast<std::uint32_t>(level + 0.5f), coarsest)], at,
                        linear);
  }
  const auto fine = static_cast<std::uint32_t>(level);
  const float blend = level - static_cast<float>(fine);
  const Vec4 finer = sample_level(texture, image.levels[fine], at, linear);
  if (blend == 0) return finer;
  return finer * (1 - blend) + sample_level(texture, image.levels[fine + 1], at, linear) * blend;
}

// The mean over the whole image, linear: its coarsest level.
inline Vec4 average_texel(const Texture& texture) {
  const MipImage& image = *texture.image;
  return texture_detail::decoded(image.texels(image.levels.back()), image.srgb ? kLinearFromSrgb8 : kLinearFrom8);
}

}  // namespace luciole
