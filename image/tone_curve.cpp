// SPDX-License-Identifier: Apache-2.0
#include "image/tone_curve.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "base/parallel.h"

#define LUCIOLE_FN inline
namespace luciole::f32 {
#include "image/pbr_neutral.h"
}
#undef LUCIOLE_FN

namespace luciole {
namespace {

constexpr std::array<std::pair<std::string_view, ToneCurve>, 2> kNames{
    {{"pbr-neutral", ToneCurve::pbr_neutral}, {"linear", ToneCurve::linear}}};

constexpr std::size_t kGrain = 4096;  // [pixels]

// srgb_code() without its power: a value's leading bits name a code it has surely reached, from which the next edges
// are at most a few away.
class CodeTable {
 public:
  CodeTable() : edges_(srgb_code_edges()) {
    for (std::uint32_t i = 0; i < kEntries; ++i) reached_[i] = srgb_code(std::bit_cast<float>(i << kDropped));
  }

  std::uint8_t code(float linear) const {
    const float x = f32::within_unit(linear);
    std::uint32_t code = reached_[std::bit_cast<std::uint32_t>(x) >> kDropped];
    while (code < edges_.size() && x >= edges_[code]) ++code;
    return static_cast<std::uint8_t>(code);
  }

 private:
  static constexpr std::uint32_t kDropped = 16;  // bits of a float
  static constexpr std::uint32_t kEntries = (std::bit_cast<std::uint32_t>(1.0f) >> kDropped) + 1;

  std::array<float, 255> edges_;
  std::array<std::uint8_t, kEntries> reached_;
};

}  // namespace

std::optional<ToneCurve> tone_curve_by_name(std::string_view name) {
  for (const auto& [known, curve] : kNames) {
    if (name == known) return curve;
  }
  return std::nullopt;
}

std::string_view tone_curve_name(ToneCurve curve) {
  return std::find_if(kNames.begin(), kNames.end(), [&](const auto& entry) { return entry.second == curve; })->first;
}

Vec3 apply_tone_curve(ToneCurve curve, Vec3 exposed) {
  const Vec3 input = f32::above_zero3(exposed);
  return f32::within_unit3(curve == ToneCurve::pbr_neutral ? f32::pbr_neutral(input) : input);
}

std::vector<Vec3> to_display(const std::vector<Vec3>& radiance, float exposure, ToneCurve curve) {
  std::vector<Vec3> display(radiance.size());
  parallel_for(radiance.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) display[i] = apply_tone_curve(curve, radiance[i] * exposure);
  });
  return display;
}

float srgb_encode(float linear) {
  const float x = f32::within_unit(linear);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
  const float x = f32::within_unit(encoded);
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

std::uint8_t srgb_code(float linear) { return static_cast<std::uint8_t>(srgb_encode(linear) * 255.0f + 0.5f); }

std::vector<std::uint8_t> srgb_codes(const std::vector<Vec3>& display) {
  static const CodeTable table;
  std::vector<std::uint8_t> codes(display.size() * 3);
  parallel_for(display.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 colour = display[i];
      codes[3 * i] = table.code(colour.x), codes[3 * i + 1] = table.code(colour.y);
      codes[3 * i + 2] = table.code(colour.z);
    }
  });
  return codes;
}

std::array<float, 255> srgb_code_edges() {
  std::array<float, 255> edges;
  std::uint32_t below = 0;  // bits of positive floats are in the order of their values
  for (int code = 1; code <= 255; ++code) {
    std::uint32_t reached = std::bit_cast<std::uint32_t>(1.0f);
    while (reached - below > 1) {
      const std::uint32_t middle = below + (reached - below) / 2;
      (srgb_code(std::bit_cast<float>(middle)) >= code ? reached : below) = middle;
    }
    edges[static_cast<std::size_t>(code) - 1] = std::bit_cast<float>(reached);
  }
  return edges;
}

}  // namespace luciole
