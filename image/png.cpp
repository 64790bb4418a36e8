// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <png.h>

#include <cstdio>

#include "image/image.h"
#include "image/output_file.h"
#include "image/tone_curve.h"

namespace luciole {
namespace {

// libpng leaves by longjmp when it fails: nothing with a destructor may live in this function.
bool write_chunks(std::FILE* stream, const std::uint8_t* bytes, std::uint32_t width, std::uint32_t height) {
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, [](png_structp, png_const_charp) {});
  png_infop header = png == nullptr ? nullptr : png_create_info_struct(png);
  if (header == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &header);
    return false;
  }
  png_init_io(png, stream);
  png_set_IHDR(png, header, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, header, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, header);
  for (std::uint32_t row = 0; row < height; ++row) png_write_row(png, bytes + std::size_t(row) * width * 3);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &header);
  return true;
}

}  // namespace

Status write_png_codes(const std::vector<std::uint8_t>& codes, std::uint32_t width, std::uint32_t height,
                       const std::filesystem::path& path) {
  if (width == 0 || height == 0 || width > kMaxImageSide || height > kMaxImageSide) {
    return cannot_write(path, "its size is not within 1 to " + std::to_string(kMaxImageSide) + " pixels a side");
  }
  if (codes.size() != std::size_t(width) * height * 3) return cannot_write(path, "the number of pixels is wrong");
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (!write_chunks(file->stream(), codes.data(), width, height)) return cannot_write(path, "the PNG writer failed");
  return file->commit();
}

Status write_png(const std::vector<Vec3>& pixels, std::uint32_t width, std::uint32_t height,
                 const std::filesystem::path& path) {
  return write_png_codes(srgb_codes(pixels), width, height, path);
}

}  // namespace luciole
