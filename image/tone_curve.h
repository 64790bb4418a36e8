// SPDX-License-Identifier: Apache-2.0
// From scene-linear radiance to what a screen shows: exposure, then a named tone curve, then the sRGB encoding.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/vector.h"

namespace luciole {

// Names on the command line: "pbr-neutral", "linear".
enum class ToneCurve {
  pbr_neutral,  // Khronos PBR Neutral: keeps base colours as they are up to 0.76, compresses highlights above
  linear,       // clamps to [0,1]
};

std::optional<ToneCurve> tone_curve_by_name(std::string_view name);
std::string_view tone_curve_name(ToneCurve curve);

// Display-linear colour in [0,1] of an exposed scene-linear one. What is negative or not a number counts as 0.
Vec3 apply_tone_curve(ToneCurve curve, Vec3 exposed);

// Every pixel multiplied by the exposure scale E [m^2 sr/W] and sent through the curve.
std::vector<Vec3> to_display(const std::vector<Vec3>& radiance, float exposure, ToneCurve curve);

// IEC 61966-2-1 transfer function and its inverse, [0,1] to [0,1]; the argument is clamped, NaN counts as 0.
float srgb_encode(float linear);
float srgb_decode(float encoded);

// What an 8-bit file has for a display-linear value: the nearest code.
std::uint8_t srgb_code(float linear);
// The same of whole pictures: red, green, blue of each pixel.
std::vector<std::uint8_t> srgb_codes(const std::vector<Vec3>& display);
// Where the codes from 1 on begin: the smallest display-linear value of each.
std::array<float, 255> srgb_code_edges();

// Luminance of linear Rec. 709 (second row of its matrix to CIE XYZ).
inline float luminance(Vec3 linear) { return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z; }

}  // namespace luciole
