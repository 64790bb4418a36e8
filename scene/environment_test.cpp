// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene/load_environment.h"

namespace luciole::test {
namespace {

Result<Environment> read(const std::string& size, const Bytes& pixels, const std::string& format = "32-bit_rle_rgbe") {
  const std::string header = "#?RADIANCE\nFORMAT=" + format + "\n\n" + size + "\n";
  Bytes file(header.begin(), header.end());
  for (const std::uint8_t byte : pixels) file.push_back(byte);
  return read_radiance_picture(file, "sky.hdr");
}

TEST(RadiancePicture, shares_an_exponent_between_channels) {
  const Result<Environment> picture = read("-Y 1 +X 2", {128, 64, 0, 129, 255, 255, 255, 0});
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_FLOAT_EQ(picture->pixels[0].x, 1.0f);  // 128 * 2^(129 - 136)
  EXPECT_FLOAT_EQ(picture->pixels[0].y, 0.5f);
  EXPECT_EQ(picture->pixels[1].x, 0);  // exponent 0 is black
}

TEST(RadiancePicture, unpacks_runs_and_copies) {
  Bytes row = {2, 2, 0, 10};
  for (const std::uint8_t value : {128, 64, 32, 129}) {
    for (const int byte : {128 + 6, int(value), 4, 1, 2, 3, int(value)}) row.push_back(static_cast<std::uint8_t>(byte));
  }
  const Result<Environment> picture = read("-Y 1 +X 10", row);
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_FLOAT_EQ(picture->pixels[5].z, 0.25f);
  EXPECT_FLOAT_EQ(picture->pixels[9].x, 1.0f);
}

TEST(RadiancePicture, refuses_broken_files_by_name) {
  const Bytes pixel = {1, 1, 1, 128};
  for (const char* size : {"-Y 1 +X 2", "-Y 0 +X 1", "-Y 1 +X 16385", "+Y 1 +X 1", "-Y 16384 +X 16384"}) {
    const Result<Environment> picture = read(size, pixel);
    ASSERT_FALSE(picture) << size;
    EXPECT_EQ(picture.error().message.find("sky.hdr: "), 0u);
  }
  EXPECT_TRUE(read("-Y 1 +X 1", pixel));
  EXPECT_FALSE(read("-Y 1 +X 1", pixel, "32-bit_rle_xyze"));
  EXPECT_FALSE(read("-Y 1 +X 8", {2, 2, 0, 8, 128 + 9, 1}));  // a run longer than its row
  EXPECT_FALSE(read_radiance_picture({}, "sky.hdr"));
}

}  // namespace
}  // namespace luciole::test
