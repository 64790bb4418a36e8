// SPDX-License-Identifier: Apache-2.0
// PNG files for screens.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace luciole {

// Writes 8-bit RGB with an sRGB chunk. Equal pixels give equal files.
//   pixels   display-linear Rec. 709 (after the tone curve), [0,1] and clamped to it; width * height, row 0 on top
Status write_png(const std::vector<Vec3>& pixels, std::uint32_t width, std::uint32_t height,
                 const std::filesystem::path& path);
//   codes    the 8-bit values themselves, as srgb_codes() gives them: 3 * width * height
Status write_png_codes(const std::vector<std::uint8_t>& codes, std::uint32_t width, std::uint32_t height,
                       const std::filesystem::path& path);

}  // namespace luciole
