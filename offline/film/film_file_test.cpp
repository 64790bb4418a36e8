// SPDX-License-Identifier: Apache-2.0
#include "offline/film/film_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "image/exr.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;
const fs::path kScratch = LUCIOLE_SCRATCH_DIR;

// Sums of every size and sign that a film can hold.
FilmFile sample_file(std::uint32_t width = 17, std::uint32_t height = 5) {
  std::mt19937_64 random(11);
  std::vector<Film::Pixel> pixels(std::size_t(width) * height);
  for (Film::Pixel& sums : pixels) {
    for (std::size_t i = 0; i < Film::kSums; ++i) {
      const std::int64_t any = static_cast<std::int64_t>(random() >> (1 + random() % 62));
      sums[i] = i < Film::kSquares  ? any * (random() % 2 ? 1 : -1)
                : i < Film::kAlbedo ? any
                                    : any % (std::int64_t(1) << 40) * (random() % 2 ? 1 : -1);
    }
  }
  pixels[0] = {-1,
               -(std::int64_t(1) << 45),
               std::numeric_limits<std::int64_t>::max(),
               (std::int64_t(1) << 44) - 1,
               std::int64_t(1) << 44,
               2,
               -1,
               -(std::int64_t(1) << 22),
               1 - (std::int64_t(1) << 22),
               -(std::int64_t(1) << 43),
               3,
               -4};
  return {Film::from_sums(width, height, 0.1f, {5, 5 + (1 << 14)}, 3, std::move(pixels)),
          {{"luciole.shot", "sponza"}, {"luciole.seed", "1"}}};
}

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void expect_refused(const fs::path& path, const std::string& phrase) {
  const Result<FilmFile> file = read_film(path);
  ASSERT_FALSE(file.has_value());
  EXPECT_NE(file.error().message.find(phrase), std::string::npos) << file.error().message;
  EXPECT_NE(file.error().message.find(path.filename().string()), std::string::npos) << file.error().message;
  EXPECT_EQ(file.error().message.find('\n'), std::string::npos);
}

TEST(FilmFile, gives_back_every_bit) {
  const FilmFile written = sample_file();
  const fs::path path = kScratch / "film.exr";
  ASSERT_TRUE(write_film(written, path).has_value());
  const Result<FilmFile> read = read_film(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->film.pixels(), written.film.pixels());
  EXPECT_EQ(read->film.width(), 17u);
  EXPECT_EQ(read->film.height(), 5u);
  EXPECT_EQ(read->film.exposure(), 0.1f);
  EXPECT_EQ(read->film.range(), written.film.range());
  EXPECT_EQ(read->film.saturated(), 3u);
  EXPECT_EQ(read->metadata, written.metadata);
}

TEST(FilmFile, shows_the_mean_to_any_reader_of_pictures) {
  const FilmFile written = sample_file();
  const fs::path path = kScratch / "visible.exr";
  ASSERT_TRUE(write_film(written, path).has_value());
  const Result<Image> picture = read_exr(path);
  ASSERT_TRUE(picture.has_value());
  for (const char* channel : {"R", "G", "B"}) {
    EXPECT_EQ(picture->channels.at(channel), written.film.image().channels.at(channel));
  }
  EXPECT_EQ(picture->channels.size(), 39u);
}

TEST(FilmFile, a_film_without_samples_and_of_one_pixel_comes_back) {
  const fs::path path = kScratch / "empty_film.exr";
  ASSERT_TRUE(write_film({Film(1, 1, 1, 12), {}}, path).has_value());
  const Result<FilmFile> read = read_film(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->film.range(), (SampleRange{12, 12}));
}

TEST(FilmFile, ordinary_pictures_and_other_files_are_refused) {
  const fs::path path = kScratch / "foreign.exr";
  ASSERT_TRUE(write_exr(sample_file().film.image({"normal"}), path).has_value());
  expect_refused(path, "without the sums");
  write_bytes(path, "P6 1 1 255 abc");
  expect_refused(path, "not an OpenEXR file");
  expect_refused(kScratch / "no_such_film.exr", "no such file");
}

// A picture that claims to be a film, with one thing wrong each.
TEST(FilmFile, forged_sums_are_refused) {
  const fs::path good = kScratch / "forged_from.exr", path = kScratch / "forged.exr";
  ASSERT_TRUE(write_film(sample_file(), good).has_value());
  const Image image = *read_exr(good);
  const auto with = [&](auto change) {
    Image changed = image;
    change(changed);
    ASSERT_TRUE(write_exr(changed, path).has_value());
    expect_refused(path, "damaged");
  };
  with([](Image& x) { x.channels.at("sum.03.low")[7] += 1; });
  with([](Image& x) { x.channels.at("sum.03.low")[7] += 0.5f; });
  with([](Image& x) { x.channels.at("sum.03.middle")[7] = 0x1p22f; });
  with([](Image& x) { x.channels.at("sum.03.high")[7] = std::numeric_limits<float>::quiet_NaN(); });
  with([](Image& x) { x.channels.at("sum.03.high")[7] = -1; });
  with([](Image& x) { x.channels.at("sum.09.high")[7] = 0x1p18f; });
  with([](Image& x) { x.channels.erase("sum.11.high"); });
  with([](Image& x) { x.channels["more"] = x.channels.at("R"); });
  with([](Image& x) { x.metadata["film.end"] = "16390"; });
  with([](Image& x) { x.metadata["film.end"] = "4"; });
  with([](Image& x) { x.metadata["film.end"] = "18446744073709551615"; });
  with([](Image& x) { x.metadata["film.exposure"] = "0"; });
  with([](Image& x) { x.metadata.erase("film.clipped"); });
  with([](Image& x) { x.metadata["luciole.shot"] = "gallery"; });
  with([](Image& x) { x.metadata["film.version"] = "2"; });
  // The control: the same picture written again, unchanged, is the film.
  ASSERT_TRUE(write_exr(image, path).has_value());
  EXPECT_TRUE(read_film(path).has_value());
}

TEST(FilmFile, truncated_and_flipped_files_are_refused) {
  const fs::path good = kScratch / "damaged_from.exr", path = kScratch / "damaged.exr";
  ASSERT_TRUE(write_film(sample_file(), good).has_value());
  const std::string bytes = bytes_of(good);
  for (std::size_t length = 0; length < bytes.size(); length += 131) {
    write_bytes(path, bytes.substr(0, length));
    EXPECT_FALSE(read_film(path).has_value()) << length;
  }
  // A flip in the visible mean is the one kind that the sums do not mind.
  const std::vector<Film::Pixel> sums = sample_file().film.pixels();
  std::mt19937 random(1);
  int refused = 0;
  for (int trial = 0; trial < 500; ++trial) {
    std::string bad = bytes;
    bad[random() % bad.size()] ^= static_cast<char>(1 << random() % 8);
    write_bytes(path, bad);
    const Result<FilmFile> file = read_film(path);
    if (file.has_value()) {
      EXPECT_EQ(file->film.pixels(), sums);
      EXPECT_EQ(file->metadata, sample_file().metadata);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 250);
}

TEST(FilmFile, a_failed_write_leaves_the_old_file) {
  EXPECT_FALSE(write_film(sample_file(), "/no/such/folder/film.exr").has_value());
  const fs::path path = kScratch / "kept.exr";
  ASSERT_TRUE(write_film(sample_file(), path).has_value());
  FilmFile reserved = sample_file();
  reserved.metadata["compression"] = "none";
  EXPECT_FALSE(write_film(reserved, path).has_value());
  EXPECT_TRUE(read_film(path).has_value());
}

}  // namespace
}  // namespace luciole
