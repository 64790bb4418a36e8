// SPDX-License-Identifier: Apache-2.0
// The sRGB transfer function (IEC 61966-2-1) for 8-bit channels.
#pragma once
#include <array>
#include <cstdint>

namespace luciole {

float linear_from_srgb(float encoded);  // [0,1] to [0,1]

// linear_from_srgb(i / 255) for each i.
extern const std::array<float, 256> kLinearFromSrgb8;
// i / 255 for each i.
extern const std::array<float, 256> kLinearFrom8;

// The 8-bit code nearest to a linear value in sRGB's own scale; inverse of kLinearFromSrgb8.
std::uint8_t srgb8_from_linear(float linear);

}  // namespace luciole
