// SPDX-License-Identifier: Apache-2.0
#include "image/tone_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace luciole {
namespace {

constexpr std::array<std::pair<std::string_view, ToneCurve>, 2> kNames{
    {{"pbr-neutral", ToneCurve::pbr_neutral}, {"linear", ToneCurve::linear}}};

float non_negative(float x) { return x > 0 ? std::min(x, 1e30f) : 0.0f; }
float unit(float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; }

// Khronos PBR Neutral Tone Mapper specification (Khronos Group, 2024); its F90, K_s, K_d in words:
//   1. What a dielectric of index 1.5 reflects at normal incidence (0.04) is taken off the darkest channel smoothly, so
//      that a white-lit surface shows its base colour.
//   2. A peak above 0.8 - 0.04 is compressed by a hyperbola towards 1, with slope 1 where it starts.
//   3. What is compressed is mixed towards white, the more the farther the peak moved.
Vec3 pbr_neutral(Vec3 exposed) {
  constexpr float kReflection = 0.04f, kStart = 0.8f - kReflection, kDesaturation = 0.15f;
  const float darkest = std::min({exposed.x, exposed.y, exposed.z});
  const float offset = darkest <= 2 * kReflection ? darkest - darkest * darkest / (4 * kReflection) : kReflection;
  const Vec3 base = exposed - Vec3(offset, offset, offset);
  const float peak = std::max({base.x, base.y, base.z});
  if (peak <= kStart) return base;
  const float compressed = 1 - (1 - kStart) * (1 - kStart) / (peak + 1 - 2 * kStart);
  const float saturation = 1 / (kDesaturation * (peak - compressed) + 1);
  const float white = compressed * (1 - saturation);
  return base * (compressed / peak * saturation) + Vec3(white, white, white);
}

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
  const Vec3 input(non_negative(exposed.x), non_negative(exposed.y), non_negative(exposed.z));
  const Vec3 output = curve == ToneCurve::pbr_neutral ? pbr_neutral(input) : input;
  return Vec3(unit(output.x), unit(output.y), unit(output.z));
}

std::vector<Vec3> to_display(const std::vector<Vec3>& radiance, float exposure, ToneCurve curve) {
  std::vector<Vec3> display;
  display.reserve(radiance.size());
  for (const Vec3& pixel : radiance) display.push_back(apply_tone_curve(curve, pixel * exposure));
  return display;
}

float srgb_encode(float linear) {
  const float x = unit(linear);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
  const float x = unit(encoded);
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

}  // namespace luciole
