// SPDX-License-Identifier: Apache-2.0
#include "offline/film/film_file.h"

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/digest.h"
#include "base/parallel.h"
#include "base/setting_table.h"
#include "image/exr.h"

namespace luciole {
namespace {

constexpr int kPieceBits = 22;
constexpr std::int64_t kPiece = std::int64_t(1) << kPieceBits;
constexpr std::array<const char*, 3> kPieceNames = {"low", "middle", "high"};
constexpr std::size_t kGrain = 1024;                          // [pixels]
constexpr std::uint64_t kMaxBytes = std::uint64_t(64) << 30;  // the largest picture's sums take 39 GiB
constexpr std::size_t kPictureChannels = 3;
constexpr const char* kMagic = "film.version";
constexpr const char* kVersion = "1";

std::string channel_name(std::size_t sum, std::size_t piece) {
  const std::string number = {static_cast<char>('0' + sum / 10), static_cast<char>('0' + sum % 10)};
  return "sum." + number + "." + kPieceNames[piece];
}

// Low and middle take bits 0..21 and 22..43 as they are; the arithmetic shift leaves the sign to high.
std::array<float, 3> cut(std::int64_t sum) {
  return {static_cast<float>(sum & (kPiece - 1)), static_cast<float>(sum >> kPieceBits & (kPiece - 1)),
          static_cast<float>(sum >> (2 * kPieceBits))};
}

bool is_whole(float value, std::int64_t low, std::int64_t end) {
  return value >= static_cast<float>(low) && value < static_cast<float>(end) && value == std::floor(value);
}

// Empty if no sum was cut into these.
std::optional<std::int64_t> put_together(float low, float middle, float high) {
  constexpr std::int64_t kHigh = std::int64_t(1) << (63 - 2 * kPieceBits);
  if (!is_whole(low, 0, kPiece) || !is_whole(middle, 0, kPiece) || !is_whole(high, -kHigh, kHigh)) return std::nullopt;
  return static_cast<std::int64_t>(high) * kPiece * kPiece + static_cast<std::int64_t>(middle) * kPiece +
         static_cast<std::int64_t>(low);
}

std::map<std::string, std::string> film_metadata(const Film& film) {
  return {{kMagic, kVersion},
          {"film.first", std::to_string(film.range().first)},
          {"film.end", std::to_string(film.range().end)},
          {"film.exposure", number_text(film.exposure())},
          {"film.clipped", std::to_string(film.saturated())}};
}

std::string digest_of(const std::map<std::string, std::string>& metadata, const Film& film) {
  Digest digest;
  for (const auto& [name, text] : metadata) digest.add(name), digest.add(text);
  digest.add_word(film.width());
  digest.add(film.pixels());
  return digest.hexadecimal();
}

void add_sums(const Film& film, Image& image) {
  std::array<float*, 3 * Film::kSums> pieces{};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<float>& channel = image.channels[channel_name(i / 3, i % 3)];
    channel.resize(film.pixels().size());
    pieces[i] = channel.data();
  }
  parallel_for(film.pixels().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t sum = 0; sum < Film::kSums; ++sum) {
      float* const* const piece = &pieces[3 * sum];
      for (std::size_t i = begin; i < end; ++i) {
        const std::array<float, 3> cuts = cut(film.pixels()[i][sum]);
        piece[0][i] = cuts[0], piece[1][i] = cuts[1], piece[2][i] = cuts[2];
      }
    }
  });
}

// Whether adding further samples to such a pixel is safe: squares never negative, albedo and normal bounded.
bool plausible(const Film::Pixel& sums, std::uint64_t count) {
  const double bound = double(count) * Film::kLargestFeature * 0x1p28;
  for (std::size_t i = Film::kSquares; i < Film::kSums; ++i) {
    if (i < Film::kAlbedo ? sums[i] < 0 : std::abs(double(sums[i])) > bound) return false;
  }
  return true;
}

// Empty if a channel is missing or holds what no sum was cut into.
std::optional<std::vector<Film::Pixel>> sums_of(const Image& image, std::uint64_t count) {
  std::array<const float*, 3 * Film::kSums> pieces{};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto channel = image.channels.find(channel_name(i / 3, i % 3));
    if (channel == image.channels.end()) return std::nullopt;
    pieces[i] = channel->second.data();
  }
  std::vector<Film::Pixel> pixels(image.pixel_count());
  std::atomic<bool> good{true};
  parallel_for(pixels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t sum = 0; sum < Film::kSums; ++sum) {
        const float* const* piece = &pieces[3 * sum];
        const std::optional<std::int64_t> whole = put_together(piece[0][i], piece[1][i], piece[2][i]);
        if (!whole) good = false;
        pixels[i][sum] = whole.value_or(0);
      }
      if (!plausible(pixels[i], count)) good = false;
    }
  });
  if (!good) return std::nullopt;
  return pixels;
}

std::optional<FilmFile> film_of(const Image& image) {
  std::map<std::string, std::string> metadata = image.metadata;
  const auto taken = [&](const char* name) {
    const auto node = metadata.extract(name);
    return node.empty() ? std::string() : node.mapped();
  };
  SampleRange range;
  std::uint64_t clipped = 0;
  float exposure = 0;
  if (taken(kMagic) != kVersion || !parse_number(taken("film.first"), range.first) ||
      !parse_number(taken("film.end"), range.end) || !parse_number(taken("film.clipped"), clipped) ||
      !parse_positive(taken("film.exposure"), exposure) || range.first > range.end || range.end > Film::kMostSamples ||
      image.channels.size() != kPictureChannels + 3 * Film::kSums) {
    return std::nullopt;
  }
  const std::string digest = taken("film.digest");
  std::optional<std::vector<Film::Pixel>> pixels = sums_of(image, range.count());
  if (!pixels) return std::nullopt;
  Film film = Film::from_sums(image.width, image.height, exposure, range, clipped, std::move(*pixels));
  std::map<std::string, std::string> signed_metadata = metadata;
  signed_metadata.merge(film_metadata(film));
  if (digest != digest_of(signed_metadata, film)) return std::nullopt;
  return FilmFile{std::move(film), std::move(metadata)};
}

}  // namespace

Status write_film(const FilmFile& file, const std::filesystem::path& path) {
  Image image = file.film.image();
  add_sums(file.film, image);
  image.metadata = file.metadata;
  image.metadata.merge(film_metadata(file.film));
  image.metadata["film.digest"] = digest_of(image.metadata, file.film);
  return write_exr(image, path, ExrCompression::none);
}

Result<FilmFile> read_film(const std::filesystem::path& path) {
  const Result<Image> image = read_exr(path, kMaxBytes);
  if (!image) return image.error();
  const std::string name = path.string();
  if (!image->metadata.contains(kMagic)) {
    return Error{ErrorKind::failed,
                 "cannot read " + name + ": it is a picture without the sums of a part or checkpoint"};
  }
  std::optional<FilmFile> film = film_of(*image);
  if (!film) return Error{ErrorKind::failed, "cannot read " + name + ": its sums are damaged or of another version"};
  return std::move(*film);
}

}  // namespace luciole
