// SPDX-License-Identifier: Apache-2.0
// PNG and JPEG files in memory to 8-bit RGBA.
#pragma once
#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/aligned_vector.h"
#include "scene/file_access.h"

namespace luciole {

struct DecodedImage {
  std::uint32_t width = 0, height = 0;
  AlignedVector<std::uint8_t> rgba;  // width * height * 4, row 0 on top; alpha not premultiplied
};

// What all images of one scene may take. Charged with the size that a header states, before pixels are decoded.
class TexelBudget {
 public:
  explicit TexelBudget(const LoadLimits& limits) : limits_(limits) {}
  void charge(std::uint32_t width, std::uint32_t height, const std::string& object);  // fails beyond the limits

 private:
  LoadLimits limits_;
  std::atomic<std::uint64_t> texels_{0};
};

// The kind is told by the first bytes, never by a name. Palette and grey become RGB, 16 bits become 8, colour spaces
// named in the file are ignored (glTF 2.0, 3.8.2: the use decides). Fails with IMAGE_ codes, naming `object`.
DecodedImage decode_image(std::span<const std::uint8_t> file, const std::string& object, TexelBudget& budget);

// The two formats, called by decode_image.
bool is_png(std::span<const std::uint8_t> file);
bool is_jpeg(std::span<const std::uint8_t> file);
DecodedImage decode_png(std::span<const std::uint8_t> file, const std::string& object, TexelBudget& budget);
DecodedImage decode_jpeg(std::span<const std::uint8_t> file, const std::string& object, TexelBudget& budget);

}  // namespace luciole
