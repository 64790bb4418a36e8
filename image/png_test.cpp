// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <fstream>
#include <iterator>

namespace luciole {
namespace {

namespace fs = std::filesystem;
const fs::path kScratch = LUCIOLE_SCRATCH_DIR;

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Png, stores_srgb_codes_row_by_row_from_the_top) {
  const fs::path path = kScratch / "codes.png";
  // 0.2140411 is the linear value of code 127.5; out of range and NaN are clamped.
  const std::vector<Vec3> pixels = {Vec3(0, 1, 0.21586f), Vec3(-1, 2, std::nanf("")), Vec3(1, 0, 0), Vec3(0, 0, 1)};
  ASSERT_TRUE(write_png(pixels, 2, 2, path).has_value());
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&image, path.c_str()));
  EXPECT_EQ(image.width, 2u);
  EXPECT_EQ(image.height, 2u);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> codes(12);
  ASSERT_TRUE(png_image_finish_read(&image, nullptr, codes.data(), 0, nullptr));
  EXPECT_EQ(codes, (std::vector<std::uint8_t>{0, 255, 128, 0, 255, 0, 255, 0, 0, 0, 0, 255}));
}

TEST(Png, carries_the_srgb_chunk_and_no_date) {
  const fs::path path = kScratch / "chunks.png";
  ASSERT_TRUE(write_png({Vec3(0.5f, 0.5f, 0.5f)}, 1, 1, path).has_value());
  const std::string bytes = bytes_of(path);
  EXPECT_NE(bytes.find(std::string("\0\0\0\1sRGB\0", 9)), std::string::npos);
  EXPECT_EQ(bytes.find("tIME"), std::string::npos);
  ASSERT_TRUE(write_png({Vec3(0.5f, 0.5f, 0.5f)}, 1, 1, path).has_value());
  EXPECT_EQ(bytes_of(path), bytes);
}

TEST(Png, refuses_wrong_sizes_and_leaves_no_file) {
  const fs::path path = kScratch / "refused.png";
  EXPECT_FALSE(write_png({}, 0, 0, path).has_value());
  EXPECT_FALSE(write_png({Vec3(0, 0, 0)}, 2, 1, path).has_value());
  EXPECT_FALSE(write_png({}, 20000, 1, path).has_value());
  EXPECT_FALSE(fs::exists(path));
  EXPECT_FALSE(write_png({Vec3(0, 0, 0)}, 1, 1, "/no/such/folder/a.png").has_value());
}

}  // namespace
}  // namespace luciole
