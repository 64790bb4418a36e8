// SPDX-License-Identifier: Apache-2.0
// libpng reports errors by longjmp. Everything that owns memory therefore lives outside the frame that calls setjmp,
// and nothing in between has a destructor.
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "scene/decode_image.h"
#include "scene/file_fault.h"

namespace luciole {
namespace {

struct PngInput {
  const std::uint8_t* bytes;
  std::size_t left;
  char message[128];
};

void read_bytes(png_structp png, png_bytep target, std::size_t count) {
  auto* input = static_cast<PngInput*>(png_get_io_ptr(png));
  if (count > input->left) png_error(png, "the file ends early");
  std::memcpy(target, input->bytes, count);
  input->bytes += count;
  input->left -= count;
}

void on_error(png_structp png, png_const_charp message) {
  auto* input = static_cast<PngInput*>(png_get_error_ptr(png));
  std::strncpy(input->message, message, sizeof input->message - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

// Whatever the file holds, rows come out as 8-bit RGBA.
void ask_for_rgba(png_structp png, png_infop header) {
  const int colour = png_get_color_type(png, header);
  png_set_expand(png);  // palette to RGB, fewer than 8 bits to 8, transparent colours to alpha
  png_set_scale_16(png);
  if ((colour & PNG_COLOR_MASK_COLOR) == 0) png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
}

class PngReader {
 public:
  explicit PngReader(PngInput& input) : input_(input) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input_, on_error, on_warning);
    if (png_ != nullptr) header_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &header_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool read_header(std::uint32_t* width, std::uint32_t* height) {
    if (png_ == nullptr || header_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, &input_, read_bytes);
    png_set_user_limits(png_, 0x7fffffff, 0x7fffffff);  // ours are checked by the caller, with a better sentence
    png_set_chunk_malloc_max(png_, 1u << 20);           // ancillary chunks: text, profiles
    png_set_chunk_cache_max(png_, 64);
    png_read_info(png_, header_);
    *width = png_get_image_width(png_, header_);
    *height = png_get_image_height(png_, header_);
    return true;
  }

  bool read_pixels(std::uint8_t* rgba, std::size_t row_bytes, std::uint32_t height) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    ask_for_rgba(png_, header_);
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, header_);
    if (png_get_rowbytes(png_, header_) != row_bytes) png_error(png_, "unexpected row size");
    for (int pass = 0; pass < passes; ++pass) {
      for (std::uint32_t y = 0; y < height; ++y) png_read_row(png_, rgba + y * row_bytes, nullptr);
    }
    return true;  // what follows the pixels does not concern us
  }

 private:
  PngInput& input_;
  png_structp png_ = nullptr;
  png_infop header_ = nullptr;
};

}  // namespace

bool is_png(std::span<const std::uint8_t> file) { return file.size() >= 8 && png_sig_cmp(file.data(), 0, 8) == 0; }

DecodedImage decode_png(std::span<const std::uint8_t> file, const std::string& object, TexelBudget& budget) {
  PngInput input{file.data(), file.size(), {}};
  PngReader reader(input);
  DecodedImage image;
  if (!reader.read_header(&image.width, &image.height)) {
    fail("IMAGE_DATA_INVALID", object, "is a broken PNG: " + printable(input.message));
  }
  budget.charge(image.width, image.height, object);
  image.rgba.resize(std::size_t(image.width) * image.height * 4);
  if (!reader.read_pixels(image.rgba.data(), std::size_t(image.width) * 4, image.height)) {
    fail("IMAGE_DATA_INVALID", object, "is a broken PNG: " + printable(input.message));
  }
  return image;
}

}  // namespace luciole
