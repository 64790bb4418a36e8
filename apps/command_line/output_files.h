// SPDX-License-Identifier: Apache-2.0
// The files that a run of frames writes: checked before anything is rendered, written whole or not at all.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "image/image.h"
#include "image/tone_curve.h"

namespace luciole {

struct FrameRange {
  std::uint64_t first = 0, last = 0;  // both are rendered
  bool numbered = false;              // asked for by --frames: names carry the number
};

// "7" or "A-B" with A <= B.
Result<FrameRange> parse_frame_range(const std::string& text);

class OutputFiles {
 public:
  // Refused: endings other than .exr and .png, two equal names, "####" missing from a name of numbered frames, and
  // whatever cannot be written. Nothing is left behind by the check.
  static Result<OutputFiles> create(std::vector<std::filesystem::path> names, const FrameRange& frames);

  bool any_exr() const { return any(".exr"); }
  bool any_png() const { return any(".png"); }
  const std::vector<std::filesystem::path>& names() const { return names_; }

  // The picture of one frame, under all names.
  //   shown   what a screen shows of it, srgb_codes() (image/tone_curve.h); may be empty without any .png
  Status write(const Image& image, const std::vector<std::uint8_t>& shown, std::uint64_t frame) const;

 private:
  bool any(const char* extension) const;

  std::vector<std::filesystem::path> names_;
  bool numbered_ = false;
};

// Linear with layers and metadata as .exr; exposed, through the curve and sRGB as .png.
Status write_picture(const Image& image, const std::filesystem::path& path, float exposure, ToneCurve curve);

// Whether a file of this name can be created: tried, and taken back.
Status check_writable(const std::filesystem::path& path);

}  // namespace luciole
