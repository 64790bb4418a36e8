// SPDX-License-Identifier: Apache-2.0
#include "scene/decode_image.h"

#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>

#include "scene/file_fault.h"

namespace luciole::test {
namespace {

DecodedImage decode(const Bytes& file) {
  TexelBudget budget{LoadLimits{}};
  return decode_image(file, "image 0", budget);
}

std::string fault_of(const Bytes& file) {
  try {
    decode(file);
  } catch (const FileFault& fault) {
    return fault.what();
  }
  return "";
}

// Two pixels in one of libpng's formats.
Bytes png_of(png_uint_32 format, const void* pixels, const void* colour_map = nullptr) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 2;
  image.height = 1;
  image.format = format;
  image.colormap_entries = colour_map == nullptr ? 0 : 2;
  Bytes file(4096);
  png_alloc_size_t size = file.size();
  EXPECT_NE(png_image_write_to_memory(&image, file.data(), &size, 0, pixels, 0, colour_map), 0) << image.message;
  file.resize(size);
  return file;
}

TEST(DecodeImage, reads_grey_palette_and_16_bit_png_as_stored) {
  const std::uint8_t grey[] = {10, 200};
  EXPECT_EQ(decode(png_of(PNG_FORMAT_GRAY, grey)).rgba,
            (AlignedVector<std::uint8_t>{10, 10, 10, 255, 200, 200, 200, 255}));
  const std::uint8_t index[] = {1, 0}, map[] = {1, 2, 3, 4, 50, 60, 70, 255};
  EXPECT_EQ(decode(png_of(PNG_FORMAT_RGBA_COLORMAP, index, map)).rgba,
            (AlignedVector<std::uint8_t>{50, 60, 70, 255, 1, 2, 3, 4}));
  // Written with a gamma of 1, which the format tells us to ignore: 0x8080 of 0xffff is 128 of 255. With the gamma it
  // would be 188.
  const std::uint16_t deep[] = {0x8080, 0xffff};
  EXPECT_EQ(decode(png_of(PNG_FORMAT_LINEAR_Y, deep)).rgba,
            (AlignedVector<std::uint8_t>{128, 128, 128, 255, 255, 255, 255, 255}));
}

TEST(DecodeImage, refuses_png_files_that_end_early) {
  const std::uint8_t grey[] = {10, 200};
  Bytes file = png_of(PNG_FORMAT_GRAY, grey);
  for (const std::size_t size : {file.size() - 16, file.size() / 2, std::size_t(20), std::size_t(8)}) {
    const std::string fault = fault_of(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)));
    EXPECT_NE(fault.find("image 0: is a broken PNG"), std::string::npos) << size << " " << fault;
  }
  EXPECT_NE(fault_of({1, 2, 3}).find("IMAGE_UNRECOGNIZED_FORMAT"), std::string::npos);
}

// A 16 x 16 image of one colour; `format` is TJPF_RGB or TJPF_CMYK.
Bytes jpeg_of(int format, const Bytes& colour) {
  Bytes pixels;
  for (int i = 0; i < 256; ++i) pixels.insert(pixels.end(), colour.begin(), colour.end());
  tjhandle encoder = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompress2(encoder, pixels.data(), 16, 0, 16, format, &data, &size, TJSAMP_444, 95, 0), 0);
  Bytes file(data, data + size);
  tjFree(data);
  tjDestroy(encoder);
  return file;
}

TEST(DecodeImage, reads_rgb_jpeg_and_refuses_cmyk) {
  const DecodedImage image = decode(jpeg_of(TJPF_RGB, {200, 100, 50}));
  EXPECT_EQ(image.width, 16u);
  EXPECT_NEAR(image.rgba[0], 200, 2);
  EXPECT_NEAR(image.rgba[1], 100, 2);
  EXPECT_EQ(image.rgba[3], 255);
  EXPECT_NE(fault_of(jpeg_of(TJPF_CMYK, {10, 20, 30, 40})).find("CMYK"), std::string::npos);
  EXPECT_EQ(fault_of({0xff, 0xd8, 0xff, 0xe0}).find("image 0: is a broken JPEG"), 0u)
      << fault_of({0xff, 0xd8, 0xff, 0xe0});
}

TEST(DecodeImage, believes_no_header_beyond_16384_pixels) {
  Bytes file = jpeg_of(TJPF_RGB, {1, 2, 3});
  for (std::size_t i = 0; i + 8 < file.size(); ++i) {
    if (file[i] == 0xff && file[i + 1] == 0xc0) file[i + 5] = 0x40, file[i + 6] = 0x01;  // height 16,385
  }
  EXPECT_NE(fault_of(file).find("IMAGE_SIZE"), std::string::npos);
}

}  // namespace
}  // namespace luciole::test
