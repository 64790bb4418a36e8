// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "image/exr.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

// Deflate reaches 1,032 to one. Beyond that a small file could ask for gigabytes; constant pictures stay below.
constexpr std::uint64_t kMaxCompressionRatio = 4096;
constexpr std::uint64_t kSmallPicture = std::uint64_t(64) << 20;  // [bytes], allowed at any ratio
constexpr std::size_t kMaxHeaderBytes = std::size_t(16) << 20;

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::uint32_t little_endian_32(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// The two attributes in which the library believes an inner count and allocates before it reads.
bool inner_counts_fit(const std::string& type, const char* value, std::uint64_t size) {
  if (type == "preview") {
    if (size < 8) return false;
    return 8 + std::uint64_t(4) * little_endian_32(value) * std::uint64_t(little_endian_32(value + 4)) == size;
  }
  if (type == "stringvector") {
    std::uint64_t at = 0;
    while (at + 4 <= size) at += 4 + std::uint64_t(little_endian_32(value + at));
    return at == size;
  }
  return type != "idmanifest" && type != "deepImageState";
}

// Walks the header's attributes (name, type, size, value) before the library sees them: it allocates what a size says,
// so a file of a few bytes could ask for gigabytes.
void check_header_walk(const std::string& bytes, bool is_whole_file) {
  std::size_t at = 8;  // behind magic number and version
  while (true) {
    if (at < bytes.size() && bytes[at] == '\0') return;  // an empty name ends the header
    const std::size_t name_end = bytes.find('\0', at);
    const std::size_t type_end = name_end == std::string::npos ? name_end : bytes.find('\0', name_end + 1);
    if (type_end == std::string::npos || bytes.size() - type_end < 5) break;
    const std::uint64_t size = little_endian_32(bytes.data() + type_end + 1);
    const std::size_t value = type_end + 5;
    if (size > bytes.size() - value) break;
    const std::string type = bytes.substr(name_end + 1, type_end - name_end - 1);
    if (!inner_counts_fit(type, bytes.data() + value, size)) throw Refused("its header is damaged");
    at = value + static_cast<std::size_t>(size);
  }
  throw Refused(is_whole_file ? "it is truncated or its header is damaged" : "its header is too long");
}

// Flags of the version word: OpenEXR file layout, "version field".
void check_prelude(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Refused("it cannot be opened");
  const std::uint64_t file_bytes = fs::file_size(path);
  std::string bytes(std::min<std::uint64_t>(file_bytes, kMaxHeaderBytes), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  if (bytes.size() < 8 || little_endian_32(bytes.data()) != 20000630) throw Refused("it is not an OpenEXR file");
  const std::uint32_t version = little_endian_32(bytes.data() + 4);
  if (version & 0x800) throw Refused("deep images are not read");
  if (version & 0x1000) throw Refused("files of several parts are not read");
  if (version & 0x200) throw Refused("tiled files are not read; convert it to scanlines");
  check_header_walk(bytes, bytes.size() == file_bytes);
}

void check_header(const Imf::Header& header, std::uint64_t file_bytes, std::uint64_t max_bytes) {
  if (header.hasType() && header.type() != Imf::SCANLINEIMAGE) throw Refused("only flat scanline images are read");
  const auto& window = header.dataWindow();
  const auto width = std::int64_t(window.max.x) - window.min.x + 1;
  const auto height = std::int64_t(window.max.y) - window.min.y + 1;
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) {
    throw Refused("its size is not within 1 to " + std::to_string(kMaxImageSide) + " pixels a side");
  }
  std::uint64_t channel_count = 0;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel, ++channel_count) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw Refused(std::string("channel \"") + channel.name() + "\" is subsampled");
    }
  }
  const std::uint64_t bytes =
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * channel_count * 4;
  if (channel_count == 0) throw Refused("it has no channels");
  if (bytes > max_bytes) throw Refused("its pixels take more than " + std::to_string(max_bytes >> 30) + " GiB");
  if (bytes > kSmallPicture && bytes / kMaxCompressionRatio > file_bytes) {
    throw Refused("it is too short for the size that its header states");
  }
}

// Attributes that belong to the file's own layout.
bool is_structural(std::string_view name) {
  constexpr std::string_view kNames[] = {
      "type", "name", "chunkCount", "pixelAspectRatio", "screenWindowWidth", "dwaCompressionLevel"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

template <class Number>
std::string number_text(Number value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

// Of text and numbers: other renderers store their times and samples as numbers.
std::optional<std::string> text_of(const Imf::Attribute& attribute) {
  if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) return text->value();
  if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&attribute)) return number_text(whole->value());
  if (const auto* real = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) return number_text(real->value());
  if (const auto* real = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) return number_text(real->value());
  return std::nullopt;
}

Image read_pixels(Imf::InputFile& file) {
  const Imf::Header& header = file.header();
  const auto& window = header.dataWindow();
  Image image;
  image.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
  image.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
  Imf::FrameBuffer buffer;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    auto& values = image.channels[channel.name()];
    values.resize(image.pixel_count());
    buffer.insert(channel.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), window));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const std::optional<std::string> text = text_of(attribute.attribute());
    if (text && !is_structural(attribute.name())) image.metadata[attribute.name()] = *text;
  }
  return image;
}

}  // namespace

Result<Image> read_exr(const fs::path& path, std::uint64_t max_bytes) {
  const auto cannot_read = [&](const std::string& reason) {
    return Error{ErrorKind::failed, "cannot read " + path.string() + ": " + reason};
  };
  std::error_code failure;
  if (!fs::exists(path, failure)) return cannot_read("there is no such file");
  if (!fs::is_regular_file(path, failure)) return cannot_read("it is not a regular file");
  try {
    check_prelude(path);
    // The library allocates tables by the header's height while it opens the file: it must know the limit before.
    Imf::Header::setMaxImageSize(static_cast<int>(kMaxImageSide), static_cast<int>(kMaxImageSide));
    Imf::InputFile file(path.c_str(), 0);
    check_header(file.header(), fs::file_size(path), max_bytes);
    return read_pixels(file);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::out_of_memory, "out of memory while reading " + path.string()};
  } catch (const Refused& refusal) {
    return cannot_read(refusal.what());
  } catch (const std::exception&) {
    // The library's own text names scan lines and internal functions; it helps nobody here.
    return cannot_read("it is truncated or damaged");
  }
}

}  // namespace luciole
