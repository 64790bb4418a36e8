// SPDX-License-Identifier: Apache-2.0
#include <turbojpeg.h>

#include <memory>

#include "scene/decode_image.h"
#include "scene/file_fault.h"

namespace luciole {

bool is_jpeg(std::span<const std::uint8_t> file) {
  return file.size() >= 3 && file[0] == 0xff && file[1] == 0xd8 && file[2] == 0xff;
}

DecodedImage decode_jpeg(std::span<const std::uint8_t> file, const std::string& object, TexelBudget& budget) {
  const auto destroy = [](tjhandle handle) { tjDestroy(handle); };
  const std::unique_ptr<void, decltype(destroy)> decoder(tjInitDecompress(), destroy);
  if (!decoder) fail("IMAGE_DATA_INVALID", object, "the JPEG decoder does not start");
  const auto broken = [&] {
    fail("IMAGE_DATA_INVALID", object, "is a broken JPEG: " + printable(tjGetErrorStr2(decoder.get())));
  };
  int width = 0, height = 0, subsampling = 0, colour_space = 0;
  const auto size = static_cast<unsigned long>(file.size());
  if (tjDecompressHeader3(decoder.get(), file.data(), size, &width, &height, &subsampling, &colour_space) != 0)
    broken();
  // A file that ends before its frame header passes the call above and has no size.
  if (width <= 0 || height <= 0) fail("IMAGE_UNEXPECTED_EOS", object, "is a broken JPEG: it ends inside its header");
  if (colour_space == TJCS_CMYK || colour_space == TJCS_YCCK) {
    fail("IMAGE_FEATURES_UNSUPPORTED", object, "is a CMYK JPEG; store it as RGB");
  }
  DecodedImage image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  budget.charge(image.width, image.height, object);
  image.rgba.resize(std::size_t(image.width) * image.height * 4);
  // LIMITSCANS: a progressive file of a few kilobytes may otherwise order thousands of passes over the image.
  const int status = tjDecompress2(decoder.get(), file.data(), size, image.rgba.data(), width, 0, height, TJPF_RGBA,
                                   TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS);
  // A warning is a file with a blemish that every viewer shows.
  if (status != 0 && tjGetErrorCode(decoder.get()) != TJERR_WARNING) broken();
  return image;
}

}  // namespace luciole
