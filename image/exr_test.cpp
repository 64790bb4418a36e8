// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

namespace luciole {
namespace {

namespace fs = std::filesystem;
const fs::path kScratch = LUCIOLE_SCRATCH_DIR;

// 32 x 20 pixels, two ZIP blocks, with values that compress badly enough to be interesting.
Image sample_image() {
  Image image;
  image.width = 32;
  image.height = 20;
  std::vector<Vec3> pixels(image.pixel_count());
  std::vector<float> depth(image.pixel_count());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = Vec3(0.001f * float(i), std::sin(float(i)), 1e6f / float(i + 1));
    depth[i] = float(i % 7);
  }
  image.set_colours("", pixels);
  image.set_colours("indirect", pixels);
  image.set_values("depth", depth);
  image.metadata = {{"settings", "vpls=65536\nseed=1"}, {"an attribute name of more than thirty-one letters", "x"}};
  return image;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string sample_bytes() {
  const fs::path path = kScratch / "sample.exr";
  EXPECT_TRUE(write_exr(sample_image(), path).has_value());
  return bytes_of(path);
}

void expect_refused(const std::string& bytes, const std::string& phrase) {
  const fs::path path = kScratch / "refused.exr";
  write_bytes(path, bytes);
  const auto image = read_exr(path);
  ASSERT_FALSE(image.has_value()) << phrase;
  EXPECT_NE(image.error().message.find(phrase), std::string::npos) << image.error().message;
  EXPECT_EQ(image.error().message.find('\n'), std::string::npos);
}

// Replaces the value of a four-byte integer inside the header, found by the text before it.
std::string with_integer_behind(std::string bytes, const std::string& text, std::size_t offset, std::uint32_t value) {
  const std::size_t at = bytes.find(text);
  EXPECT_NE(at, std::string::npos);
  for (std::size_t i = 0; i < 4; ++i) bytes[at + text.size() + offset + i] = static_cast<char>(value >> (8 * i));
  return bytes;
}

TEST(Exr, gives_back_every_bit_of_every_channel_and_all_metadata) {
  Image written = sample_image();
  written.channels["R"][3] = std::numeric_limits<float>::infinity();
  written.channels["R"][4] = 1e-42f;
  const fs::path path = kScratch / "round_trip.exr";
  ASSERT_TRUE(write_exr(written, path).has_value());
  const auto read = read_exr(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->width, written.width);
  EXPECT_EQ(read->height, written.height);
  EXPECT_EQ(read->channels, written.channels);
  EXPECT_EQ(read->metadata, written.metadata);
}

// Other renderers store times and samples as numbers. The text attribute of the sample becomes one of the same length.
TEST(Exr, numbers_of_other_renderers_become_text) {
  Image image = sample_image();
  image.metadata = {{"renderSeconds", "time"}};
  const fs::path path = kScratch / "numbers.exr";
  ASSERT_TRUE(write_exr(image, path).has_value());
  std::string bytes = bytes_of(path);
  const std::string text("renderSeconds\0string\0\4\0\0\0time", 13 + 1 + 6 + 1 + 4 + 4);
  const std::string number("renderSeconds_\0float\0\4\0\0\0\0\0\x48\x41", text.size());  // 12.5
  const std::size_t at = bytes.find(text);
  ASSERT_NE(at, std::string::npos);
  write_bytes(path, bytes.replace(at, text.size(), number));
  const Result<Image> read = read_exr(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  // Nothing else: the file's own numbers (its pixel aspect ratio) tell nothing of the picture.
  EXPECT_EQ(read->metadata, (std::map<std::string, std::string>{{"renderSeconds_", "12.5"}}));
}

TEST(Exr, equal_images_are_equal_files_and_other_ones_are_not) {
  const fs::path first = kScratch / "first.exr", second = kScratch / "second.exr";
  Image image = sample_image();
  ASSERT_TRUE(write_exr(image, first).has_value());
  ASSERT_TRUE(write_exr(image, second).has_value());
  EXPECT_EQ(bytes_of(first), bytes_of(second));
  image.channels["G"][5] += 1;
  ASSERT_TRUE(write_exr(image, second).has_value());
  EXPECT_NE(bytes_of(first), bytes_of(second));
}

TEST(Exr, uncompressed_files_hold_the_same_picture) {
  const fs::path zipped = kScratch / "zipped.exr", plain = kScratch / "plain.exr";
  ASSERT_TRUE(write_exr(sample_image(), zipped).has_value());
  ASSERT_TRUE(write_exr(sample_image(), plain, ExrCompression::none).has_value());
  EXPECT_GT(fs::file_size(plain), fs::file_size(zipped));
  const auto read = read_exr(plain);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->channels, sample_image().channels);
  EXPECT_EQ(read->metadata, sample_image().metadata);
}

TEST(Exr, says_that_its_primaries_are_those_of_rec_709) {
  const std::string bytes = sample_bytes();
  const std::string name("chromaticities\0chromaticities\0\x20\0\0\0", 34);
  const std::size_t at = bytes.find(name);
  ASSERT_NE(at, std::string::npos);
  float values[8];
  std::memcpy(values, bytes.data() + at + name.size(), sizeof values);
  const float expected[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  for (int i = 0; i < 8; ++i) EXPECT_FLOAT_EQ(values[i], expected[i]);
}

TEST(Exr, writing_refuses_what_cannot_be_a_file_and_leaves_none) {
  const fs::path path = kScratch / "never_written.exr";
  Image empty;
  EXPECT_FALSE(write_exr(empty, path).has_value());
  Image wrong_count = sample_image();
  wrong_count.channels["G"].pop_back();
  EXPECT_FALSE(write_exr(wrong_count, path).has_value());
  Image reserved_name = sample_image();
  reserved_name.metadata["compression"] = "none";
  const Status status = write_exr(reserved_name, path);
  ASSERT_FALSE(status.has_value());
  EXPECT_NE(status.error().message.find("compression"), std::string::npos);
  EXPECT_FALSE(fs::exists(path));
  EXPECT_FALSE(write_exr(sample_image(), "/no/such/folder/a.exr").has_value());
}

TEST(Exr, a_full_disk_is_one_sentence_and_no_file) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const Status status = write_exr(sample_image(), "/dev/full");
  ASSERT_FALSE(status.has_value());
  EXPECT_NE(status.error().message.find("/dev/full"), std::string::npos);
}

TEST(Exr, refuses_files_that_are_none_of_ours_by_name) {
  const std::string good = sample_bytes();
  const auto with_flag = [&](std::uint32_t flag) { return with_integer_behind(good, good.substr(0, 4), 0, 2 | flag); };
  expect_refused("", "not an OpenEXR file");
  expect_refused("P6 1 1 255 abc", "not an OpenEXR file");
  expect_refused(with_flag(0x800), "deep");
  expect_refused(with_flag(0x200), "tiled");
  expect_refused(with_flag(0x1000), "several parts");
  EXPECT_FALSE(read_exr(kScratch / "no_such_file.exr").has_value());
  EXPECT_FALSE(read_exr(kScratch).has_value());
}

TEST(Exr, refuses_sizes_before_it_allocates_for_them) {
  const std::string good = sample_bytes();
  const std::string window("dataWindow\0box2i\0\x10\0\0\0", 21);
  expect_refused(with_integer_behind(good, window, 8, 2000000000), "damaged");  // width, caught by the library
  expect_refused(with_integer_behind(good, window, 12, 16384), "damaged");      // height 16385
  std::string wide = with_integer_behind(good, window, 8, 16383);
  wide = with_integer_behind(wide, window, 12, 16383);
  expect_refused(wide + std::string(1 << 16, '\0'), "more than 4 GiB");  // the table of lines is there
  std::string tall = with_integer_behind(good, window, 8, 4095);
  tall = with_integer_behind(tall, window, 12, 4095);
  expect_refused(tall + std::string(1 << 16, '\0'), "too short");
  expect_refused(with_integer_behind(good, window, 12, 16383 / 4), "damaged");  // lines that are not there
  // An attribute that claims more bytes than the file has.
  const std::string text("settings\0string\0", 16);
  expect_refused(with_integer_behind(good, text, 0, 0x7fffffff), "header is damaged");
}

TEST(Exr, every_truncation_is_refused) {
  const std::string good = sample_bytes();
  for (std::size_t length = 0; length < good.size(); length += length < 1000 ? 1 : 97) {
    const fs::path path = kScratch / "truncated.exr";
    write_bytes(path, good.substr(0, length));
    EXPECT_FALSE(read_exr(path).has_value()) << length;
  }
}

TEST(Exr, corrupt_bytes_never_crash_it) {
  const std::string good = sample_bytes();
  std::mt19937 random(1);
  int refused = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::string bad = good;
    // Every other trial harms the header, which is where sizes and counts are.
    const std::size_t reach = trial % 2 == 0 ? 700 : bad.size();
    for (unsigned harm = 0; harm < 1 + random() % 4; ++harm) bad[random() % reach] = static_cast<char>(random());
    const fs::path path = kScratch / "corrupt.exr";
    write_bytes(path, bad);
    const auto image = read_exr(path);
    if (image.has_value()) {
      for (const auto& [name, values] : image->channels) ASSERT_EQ(values.size(), image->pixel_count());
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace luciole
