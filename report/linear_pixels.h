// SPDX-License-Identifier: Apache-2.0
// Radiance on its way to a page, where a script exposes it anew.
//
// A page of file:// may show an image that lies beside it, but no script may read the image's pixels, nor read a file.
// What it may do is run a script that lies beside it: so the pixels are a base64 text within one. Half floats are what
// most renderers write, and their steps, 1 part in 1,024 to 2,048, vanish in the 8 bits of a screen. A shared exponent
// with 8-bit mantissas was tried: a third smaller, but the weak channels of saturated colours were off by several
// codes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/vector.h"

namespace luciole {

// IEEE 754 binary16, nearest, ties to even. What is negative or not a number counts as 0, what is above 65504 as 65504.
std::uint16_t half_code(float value);

// Half floats of the exposed radiance (1: white), so that the range is the screen's and not the scene's. Each code less
// that of its left neighbour (modulo 65,536; 0 beside the border); the low bytes of R, of G, of B, then their high
// bytes, rows from the top; deflated in the zlib format (RFC 1950), as base64 (RFC 4648).
std::string linear_pixels_text(const std::vector<Vec3>& radiance, std::uint32_t width, float exposure);

// RFC 4648, with padding.
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace luciole
