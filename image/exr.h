// SPDX-License-Identifier: Apache-2.0
// OpenEXR files: the linear picture, its layers and its metadata.
#pragma once
#include <filesystem>

#include "base/result.h"
#include "image/image.h"

namespace luciole {

// Writes a single-part scanline file, ZIP-compressed, every channel 32-bit float, lines from top to bottom, with the
// chromaticities of Rec. 709. Metadata become text attributes of the same names; the names that OpenEXR itself uses
// ("channels", "compression", ..) are refused. Equal images give equal files: no dates, no thread counts, no host.
Status write_exr(const Image& image, const std::filesystem::path& path);

// Reads a flat, single-part scanline file; half and integer channels become float, text attributes metadata, the data
// window the picture. Refused with one sentence: deep, tiled, multi-part and subsampled files, more than kMaxImageSide
// a side, more than 4 GiB of pixels, and whatever is truncated or damaged.
Result<Image> read_exr(const std::filesystem::path& path);

}  // namespace luciole
