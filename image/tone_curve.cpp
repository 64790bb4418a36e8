// SPDX-License-Identifier: Apache-2.0
#include "image/tone_curve.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#define LUCIOLE_FN inline
namespace luciole::f32 {
#include "image/pbr_neutral.h"
}
#undef LUCIOLE_FN

namespace luciole {
namespace {

constexpr std::array<std::pair<std::string_view, ToneCurve>, 2> kNames{
    {{"pbr-neutral", ToneCurve::pbr_neutral}, {"linear", ToneCurve::linear}}};

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
  std::vector<Vec3> display;
  display.reserve(radiance.size());
  for (const Vec3& pixel : radiance) display.push_back(apply_tone_curve(curve, pixel * exposure));
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
