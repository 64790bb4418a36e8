// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include <array>

namespace luciole {
namespace {

std::string channel_name(const std::string& layer, const char* component) {
  return layer.empty() ? component : layer + "." + component;
}

// The three channels of a layer, by the first naming that the image has complete.
std::array<const std::vector<float>*, 3> find_components(const Image& image, const std::string& layer) {
  constexpr const char* kNamings[][3] = {{"R", "G", "B"}, {"X", "Y", "Z"}, {"V", "V", "V"}};
  for (const auto& naming : kNamings) {
    std::array<const std::vector<float>*, 3> found{};
    bool complete = true;
    for (int i = 0; i < 3; ++i) {
      const auto channel = image.channels.find(channel_name(layer, naming[i]));
      complete = complete && channel != image.channels.end() && channel->second.size() == image.pixel_count();
      if (complete) found[static_cast<std::size_t>(i)] = &channel->second;
    }
    if (complete) return found;
  }
  return {};
}

void set_components(Image& image, const std::string& layer, const std::array<const char*, 3>& naming,
                    const std::vector<Vec3>& pixels) {
  auto& first = image.channels[channel_name(layer, naming[0])];
  auto& second = image.channels[channel_name(layer, naming[1])];
  auto& third = image.channels[channel_name(layer, naming[2])];
  for (auto* channel : {&first, &second, &third}) channel->resize(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    first[i] = pixels[i].x;
    second[i] = pixels[i].y;
    third[i] = pixels[i].z;
  }
}

}  // namespace

bool Image::has_layer(const std::string& layer) const { return find_components(*this, layer)[0] != nullptr; }

std::vector<Vec3> Image::colours(const std::string& layer) const {
  const auto components = find_components(*this, layer);
  if (components[0] == nullptr) return {};
  std::vector<Vec3> pixels(pixel_count());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = Vec3((*components[0])[i], (*components[1])[i], (*components[2])[i]);
  }
  return pixels;
}

void Image::set_colours(const std::string& layer, const std::vector<Vec3>& pixels) {
  set_components(*this, layer, {"R", "G", "B"}, pixels);
}

void Image::set_vectors(const std::string& layer, const std::vector<Vec3>& vectors) {
  set_components(*this, layer, {"X", "Y", "Z"}, vectors);
}

void Image::set_values(const std::string& layer, const std::vector<float>& values) {
  channels[channel_name(layer, "V")] = values;
}

}  // namespace luciole
