// SPDX-License-Identifier: Apache-2.0
#include "report/light_map.h"

#include <algorithm>
#include <cmath>

namespace luciole {

Vec3 light_colour(float listed, float in_vain) {
  if (!(listed > 0)) return Vec3(0, 0, 0);
  const float value = std::min(listed / kBrightestLightCount, 1.0f);
  const float sixth = 4 * (1 - std::clamp(in_vain / listed, 0.0f, 1.0f));  // hue: 0 red, 2 green, 4 blue
  const auto channel = [&](float centre) { return value * std::clamp(2 - std::abs(sixth - centre), 0.0f, 1.0f); };
  return {channel(0), channel(2), channel(4)};
}

Result<std::vector<Vec3>> light_map(const Image& image) {
  const auto listed = image.channels.find("lights_listed.V"), in_vain = image.channels.find("lights_false.V");
  if (listed == image.channels.end() || in_vain == image.channels.end()) {
    return Error{ErrorKind::failed, "the layers lights_listed and lights_false are missing"};
  }
  std::vector<Vec3> colours(image.pixel_count());
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = light_colour(listed->second[i], in_vain->second[i]);
  return colours;
}

}  // namespace luciole
