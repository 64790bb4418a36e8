// SPDX-License-Identifier: Apache-2.0
#include "scene/load_environment.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <vector>

#include "scene/file_fault.h"

namespace luciole {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class RadianceReader {
 public:
  explicit RadianceReader(std::span<const std::uint8_t> file) : file_(file) {}

  Environment read() {
    Environment result;
    read_header(result);
    result.radiance = {1, 1, 1};
    // The shortest rows, runs of 127, take 16 bytes per 508 pixels: a header cannot promise more than the file may
    // hold.
    if (std::uint64_t(result.width) * result.height > file_.size() * std::uint64_t(16)) {
      fail("IMAGE_UNEXPECTED_EOS", "", "the file is too short for its size");
    }
    result.pixels.reserve(std::size_t(result.width) * result.height);
    std::vector<Rgbe> row(result.width);
    for (std::uint32_t y = 0; y < result.height; ++y) {
      read_row(row);
      for (const Rgbe& pixel : row) result.pixels.push_back(radiance(pixel));
    }
    return result;
  }

 private:
  static Vec3 radiance(const Rgbe& pixel) {
    if (pixel[3] == 0) return {0, 0, 0};
    const float scale = std::ldexp(1.0f, int(pixel[3]) - (128 + 8));
    return Vec3(pixel[0], pixel[1], pixel[2]) * scale;
  }

  std::uint8_t byte() {
    if (at_ == file_.size()) fail("IMAGE_UNEXPECTED_EOS", "", "the file ends inside its pixels");
    return file_[at_++];
  }

  std::string line() {
    std::string text;
    for (char c = static_cast<char>(byte()); c != '\n'; c = static_cast<char>(byte())) {
      if (text.size() == 1024) fail("IMAGE_DATA_INVALID", "", "a line of the header does not end");
      text += c;
    }
    return text;
  }

  void read_header(Environment& result) {
    if (!line().starts_with("#?")) fail("IMAGE_UNRECOGNIZED_FORMAT", "", "is no Radiance picture");
    for (std::string text = line(); !text.empty(); text = line()) {
      if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe") {
        fail("IMAGE_FEATURES_UNSUPPORTED", "", "its pixels are not RGBE");
      }
    }
    constexpr std::uint32_t kLargestSide = 16384;
    unsigned width = 0, height = 0;
    if (std::sscanf(line().c_str(), "-Y %6u +X %6u", &height, &width) != 2 || width == 0 || height == 0 ||
        width > kLargestSide || height > kLargestSide) {
      fail("IMAGE_SIZE", "", "its size is not \"-Y height +X width\" with sides from 1 to 16384");
    }
    result.width = width;
    result.height = height;
  }

  void read_row(std::vector<Rgbe>& row) {
    Rgbe first = {byte(), byte(), byte(), byte()};
    const bool runs = row.size() >= 8 && first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (!runs) {
      for (std::size_t x = 0; x < row.size(); ++x) row[x] = x == 0 ? first : Rgbe{byte(), byte(), byte(), byte()};
      return;
    }
    if (std::size_t(first[2]) * 256 + first[3] != row.size()) fail("IMAGE_DATA_INVALID", "", "a row has another width");
    for (std::size_t channel = 0; channel < 4; ++channel) read_channel(row, channel);
  }

  void read_channel(std::vector<Rgbe>& row, std::size_t channel) {
    for (std::size_t x = 0; x < row.size();) {
      const std::uint8_t code = byte();
      const bool is_run = code > 128;
      const std::size_t count = is_run ? code - 128u : code;
      if (count == 0 || count > row.size() - x) fail("IMAGE_DATA_INVALID", "", "a run leaves its row");
      const std::uint8_t value = is_run ? byte() : 0;
      for (std::size_t i = 0; i < count; ++i) row[x++][channel] = is_run ? value : byte();
    }
  }

  std::span<const std::uint8_t> file_;
  std::size_t at_ = 0;
};

}  // namespace

Result<Environment> read_radiance_picture(std::span<const std::uint8_t> file, const std::string& name) {
  try {
    return RadianceReader(file).read();
  } catch (const FileFault& fault) {
    return Error{ErrorKind::bad_scene, name + ": " + fault.what()};
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::out_of_memory, name + ": does not fit into memory"};
  }
}

Result<Environment> load_environment(const std::filesystem::path& path) {
  const Result<Bytes> file = read_regular_file(path, LoadLimits{}.file_bytes);
  if (!file) return Error{file.error().kind, path.string() + ": " + file.error().message};
  return read_radiance_picture(*file, path.filename().string());
}

}  // namespace luciole
