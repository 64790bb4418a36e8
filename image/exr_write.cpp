// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>

#include "image/exr.h"
#include "image/output_file.h"

namespace luciole {
namespace {

// OpenEXR's view of a FILE, so that a full disk is seen and the partial file stays ours to remove.
class FileStream : public Imf::OStream {
 public:
  FileStream(std::FILE* file, const char* name) : Imf::OStream(name), file_(file) {}
  void write(const char bytes[], int count) override {
    if (std::fwrite(bytes, 1, static_cast<std::size_t>(count), file_) != static_cast<std::size_t>(count)) {
      throw std::runtime_error(std::strerror(errno));
    }
  }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(ftello(file_)); }
  void seekp(std::uint64_t position) override {
    if (fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) throw std::runtime_error(std::strerror(errno));
  }

 private:
  std::FILE* file_;
};

// Why this image cannot become a file; empty if it can.
std::string objection(const Image& image) {
  if (image.width == 0 || image.height == 0) return "the image has no pixels";
  if (image.width > kMaxImageSide || image.height > kMaxImageSide) {
    return "the image is larger than " + std::to_string(kMaxImageSide) + " pixels a side";
  }
  if (image.channels.empty()) return "the image has no channels";
  for (const auto& [name, values] : image.channels) {
    if (name.empty() || name.size() > 255) return "channel names have 1 to 255 characters";
    if (values.size() != image.pixel_count()) return "channel \"" + name + "\" has the wrong number of pixels";
  }
  return {};
}

Imf::Header header_of(const Image& image, ExrCompression compression) {
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = compression == ExrCompression::zip ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION;
  header.lineOrder() = Imf::INCREASING_Y;
  Imf::addChromaticities(header, Imf::Chromaticities());  // OpenEXR's default primaries are those of Rec. 709
  for (const auto& [name, value] : image.metadata) {
    if (name.empty() || name.size() > 255 || header.find(name) != header.end()) {
      throw std::invalid_argument("\"" + name + "\" cannot name a piece of metadata");
    }
    header.insert(name, Imf::StringAttribute(value));
  }
  for (const auto& [name, values] : image.channels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  return header;
}

Imf::FrameBuffer frame_buffer_of(const Image& image) {
  Imf::FrameBuffer buffer;
  for (const auto& [name, values] : image.channels) {
    // The library's slices serve reading and writing alike; writing does not touch the values.
    char* base = reinterpret_cast<char*>(const_cast<float*>(values.data()));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * image.width));
  }
  return buffer;
}

}  // namespace

Status write_exr(const Image& image, const std::filesystem::path& path, ExrCompression compression) {
  if (const std::string reason = objection(image); !reason.empty()) return cannot_write(path, reason);
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  try {
    FileStream stream(file->stream(), path.c_str());
    // Zero threads: compression in this thread, lines in order.
    Imf::OutputFile output(stream, header_of(image, compression), 0);
    output.setFrameBuffer(frame_buffer_of(image));
    output.writePixels(static_cast<int>(image.height));
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::out_of_memory, "out of memory while writing " + path.string()};
  } catch (const std::exception& problem) {
    return cannot_write(path, problem.what());
  }
  return file->commit();
}

}  // namespace luciole
