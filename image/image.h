// SPDX-License-Identifier: Apache-2.0
// Pixels in memory: named float channels of one size, as OpenEXR stores them. Row 0 on top. Linear Rec. 709.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace luciole {

// The largest side that is read or written [pixels].
inline constexpr std::uint32_t kMaxImageSide = 16384;

// Channel names follow OpenEXR: "R" "G" "B" for the picture itself, "layer.R" "layer.G" "layer.B" for a colour layer,
// "layer.X" .. for vectors, "layer.V" for a single value. Half or full float on disk; always float here.
struct Image {
  std::uint32_t width = 0, height = 0;
  std::map<std::string, std::vector<float>> channels;  // each width * height
  std::map<std::string, std::string> metadata;         // text attributes: settings, seed, instruction set, ...

  std::size_t pixel_count() const { return std::size_t(width) * height; }
  bool has_layer(const std::string& layer) const;             // "" is the picture
  std::vector<Vec3> colours(const std::string& layer) const;  // R,G,B (or X,Y,Z, or V thrice); empty if missing
  void set_colours(const std::string& layer, const std::vector<Vec3>& pixels);   // "layer.R", .G, .B
  void set_vectors(const std::string& layer, const std::vector<Vec3>& vectors);  // "layer.X", .Y, .Z
  void set_values(const std::string& layer, const std::vector<float>& values);   // "layer.V"
};

}  // namespace luciole
