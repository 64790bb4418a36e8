// SPDX-License-Identifier: Apache-2.0
#include "image/false_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "image/tone_curve.h"

namespace luciole {
namespace {

// sRGB codes of L* = 0, 12, .. 96. The hue (CIE LCh) runs from 285 degrees, blue, through 0, red, to 95, yellow; the
// chroma is 92 % of what a screen can show, at most 78.
constexpr std::array<std::array<float, 3>, 9> kCodes{{{0, 0, 0},
                                                      {7, 28, 76},
                                                      {79, 16, 147},
                                                      {154, 23, 124},
                                                      {216, 34, 105},
                                                      {248, 92, 83},
                                                      {250, 152, 98},
                                                      {252, 201, 126},
                                                      {254, 243, 211}}};

std::vector<Vec3> colours_of(const std::vector<float>& values, float (*scale)(float)) {
  std::vector<Vec3> colours;
  colours.reserve(values.size());
  for (const float value : values) colours.push_back(false_colour(scale(value)));
  return colours;
}

}  // namespace

Vec3 false_colour(float value) {
  const float unit = value >= 0 ? std::min(value, 1.0f) : (value < 0 ? 0.0f : 1.0f);
  const float place = unit * static_cast<float>(kCodes.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), kCodes.size() - 2);
  const float part = place - static_cast<float>(below);
  const auto channel = [&](std::size_t c) {
    return srgb_decode((kCodes[below][c] * (1 - part) + kCodes[below + 1][c] * part) / 255.0f);
  };
  return Vec3(channel(0), channel(1), channel(2));
}

float error_scale(float relative_error) {
  if (relative_error <= kLowestError) return 0;
  return std::min(std::log(relative_error / kLowestError) / std::log(kHighestError / kLowestError), 1.0f);
}

std::vector<Vec3> error_colours(const std::vector<float>& relative_error) {
  return colours_of(relative_error, error_scale);
}

std::vector<Vec3> flip_colours(const std::vector<float>& flip) {
  return colours_of(flip, [](float value) { return value; });
}

}  // namespace luciole
