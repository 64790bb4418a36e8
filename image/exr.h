// SPDX-License-Identifier: Apache-2.0
// OpenEXR files: the linear picture, its layers and its metadata.
#pragma once
#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "image/image.h"

namespace luciole {

// ZIP is small, and slow: about 20 MB of pixels per second. `none` is for what is written often and read once.
enum class ExrCompression : std::uint8_t { zip, none };

inline constexpr std::uint64_t kMaxExrBytes = std::uint64_t(4) << 30;  // of pixels in memory

// Writes a single-part scanline file, every channel 32-bit float, lines from top to bottom, with the
// chromaticities of Rec. 709. Metadata become text attributes of the same names; the names that OpenEXR itself uses
// ("channels", "compression", ..) are refused. Equal images give equal files: no dates, no thread counts, no host.
Status write_exr(const Image& image, const std::filesystem::path& path,
                 ExrCompression compression = ExrCompression::zip);

// Reads a flat, single-part scanline file; half and integer channels become float, attributes that are text or a number
// metadata, the data window the picture. Refused with one sentence: deep, tiled, multi-part and subsampled files, more
// than kMaxImageSide a side, more pixels than `max_bytes`, and whatever is truncated or damaged.
Result<Image> read_exr(const std::filesystem::path& path, std::uint64_t max_bytes = kMaxExrBytes);

}  // namespace luciole
