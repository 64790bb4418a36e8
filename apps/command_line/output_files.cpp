// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "image/exr.h"
#include "image/output_file.h"
#include "image/png.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNumber = "####";
constexpr std::uint64_t kLastFrame = 0xffffffff;  // [frame index]

bool parse_whole(std::string_view text, std::uint64_t& number) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() && end == text.data() + text.size();
}

fs::path with_number(const fs::path& name, std::uint64_t frame) {
  std::string text = name.string();
  text.replace(text.find(kNumber), kNumber.size(), fmt::format("{:04}", frame));
  return text;
}

}  // namespace

Result<FrameRange> parse_frame_range(const std::string& text) {
  FrameRange range{0, 0, true};
  const std::size_t dash = text.find('-');
  const std::string_view first = std::string_view(text).substr(0, dash);
  const std::string_view last = dash == std::string::npos ? first : std::string_view(text).substr(dash + 1);
  if (!parse_whole(first, range.first) || !parse_whole(last, range.last) || range.first > range.last ||
      range.last > kLastFrame) {
    return Error{ErrorKind::usage, "frames must be A-B with whole numbers A <= B, not '" + text + "'"};
  }
  return range;
}

Status check_writable(const fs::path& path) {
  const Result<OutputFile> tried = OutputFile::create(path);
  if (!tried) return tried.error();
  return Done{};
}

Result<OutputFiles> OutputFiles::create(std::vector<fs::path> names, const FrameRange& frames) {
  std::set<fs::path> seen;
  for (const fs::path& name : names) {
    const std::string text = name.string();
    if (name.extension() != ".exr" && name.extension() != ".png") {
      return Error{ErrorKind::usage, text + ": pictures end in .exr or .png"};
    }
    if (!seen.insert(name).second) return Error{ErrorKind::usage, text + ": named twice as output"};
    if (frames.numbered && text.find(kNumber) == std::string::npos) {
      return Error{ErrorKind::usage, text + ": with --frames the name needs #### where the number goes"};
    }
    for (const std::uint64_t frame : {frames.first, frames.last}) {
      if (Status status = check_writable(frames.numbered ? with_number(name, frame) : name); !status) {
        return status.error();
      }
    }
  }
  OutputFiles files;
  files.names_ = std::move(names);
  files.numbered_ = frames.numbered;
  return files;
}

bool OutputFiles::any(const char* extension) const {
  return std::any_of(names_.begin(), names_.end(), [&](const fs::path& name) { return name.extension() == extension; });
}

Status write_picture(const Image& image, const fs::path& path, float exposure, ToneCurve curve) {
  if (path.extension() == ".exr") return write_exr(image, path);
  return write_png(to_display(image.colours(""), exposure, curve), image.width, image.height, path);
}

Status OutputFiles::write(const Image& image, const std::vector<std::uint8_t>& shown, std::uint64_t frame) const {
  for (const fs::path& name : names_) {
    const fs::path path = numbered_ ? with_number(name, frame) : name;
    Status status =
        path.extension() == ".exr" ? write_exr(image, path) : write_png_codes(shown, image.width, image.height, path);
    if (!status) return status;
  }
  return Done{};
}

}  // namespace luciole
