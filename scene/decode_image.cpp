// SPDX-License-Identifier: Apache-2.0
#include "scene/decode_image.h"

#include "scene/file_fault.h"

namespace luciole {

void TexelBudget::charge(std::uint32_t width, std::uint32_t height, const std::string& object) {
  if (width == 0 || height == 0 || width > limits_.image_side || height > limits_.image_side) {
    fail("IMAGE_SIZE", object,
         "is " + std::to_string(width) + " x " + std::to_string(height) + " pixels; sides from 1 to " +
             std::to_string(limits_.image_side) + " are read");
  }
  const std::uint64_t texels = std::uint64_t(width) * height;
  if (texels_.fetch_add(texels) + texels > limits_.texels) {
    fail("IMAGE_SIZE", "", "all images together have more than " + std::to_string(limits_.texels) + " pixels");
  }
}

DecodedImage decode_image(std::span<const std::uint8_t> file, const std::string& object, TexelBudget& budget) {
  if (is_png(file)) return decode_png(file, object, budget);
  if (is_jpeg(file)) return decode_jpeg(file, object, budget);
  fail("IMAGE_UNRECOGNIZED_FORMAT", object, "is neither a PNG nor a JPEG image");
}

}  // namespace luciole
