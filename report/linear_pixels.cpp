// SPDX-License-Identifier: Apache-2.0
#include "report/linear_pixels.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>

namespace luciole {
namespace {

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> result(size);
  // Fails only for lack of memory: the room is sufficient, the level is known.
  if (compress2(result.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), 6) != Z_OK)
    throw std::bad_alloc();
  result.resize(size);
  return result;
}

}  // namespace

std::uint16_t half_code(float value) {
  constexpr float kLargest = 65504, kSmallestNormal = 0x1p-14f;
  const float clamped = value > 0 ? std::min(value, kLargest) : 0.0f;
  // Below, codes are multiples of 2^-24; nearbyint rounds as the processor is told, to the nearest.
  if (clamped < kSmallestNormal) return static_cast<std::uint16_t>(std::nearbyint(clamped * 0x1p24f));
  const auto bits = std::bit_cast<std::uint32_t>(clamped);
  const std::uint32_t rounded =
      bits + 0xfff + (bits >> 13 & 1);  // 13 bits of the mantissa go; half of them, or more, count
  return static_cast<std::uint16_t>((rounded >> 13) - ((127 - 15) << 10));
}

std::string linear_pixels_text(const std::vector<Vec3>& radiance, std::uint32_t width, float exposure) {
  const std::size_t count = radiance.size();
  std::vector<std::uint8_t> planes(count * 6);
  const auto add_plane = [&](std::size_t channel, float Vec3::*component) {
    std::uint16_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (i % width == 0) left = 0;
      const std::uint16_t code = half_code(radiance[i].*component * exposure);
      const auto difference = static_cast<std::uint16_t>(code - left);
      planes[channel * count + i] = static_cast<std::uint8_t>(difference);
      planes[(channel + 3) * count + i] = static_cast<std::uint8_t>(difference >> 8);
      left = code;
    }
  };
  add_plane(0, &Vec3::x), add_plane(1, &Vec3::y), add_plane(2, &Vec3::z);
  return base64(deflated(planes));
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? std::uint32_t(bytes[i + k]) : 0u; };
    const std::uint32_t word = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int digit = 0; digit < 4; ++digit) text += kDigits[word >> (18 - 6 * digit) & 63];
    if (i + 1 >= bytes.size()) text[text.size() - 2] = '=';
    if (i + 2 >= bytes.size()) text[text.size() - 1] = '=';
  }
  return text;
}

}  // namespace luciole
