// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/reference_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "real_time/filtering/synthetic_room.h"

namespace luciole {
namespace {

constexpr double kUnit = 5.9604644775390625e-8;  // 2^-24: relative rounding of one float operation
using Double3 = std::array<double, 3>;

Double3 at3(const Plane3& planes, std::size_t at) { return {planes[0][at], planes[1][at], planes[2][at]}; }
double dot3(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double footprint_of(const GeometryBuffer& g) { return 2.0 * std::tan(0.5 * double(g.camera.vertical_fov)) / g.height; }

// The biweight and how far an error of its argument moves it.
struct Weight {
  double value = 0, rounding = 0;
};
Weight biweight(double t, double t_rounding) {
  Weight w;
  const double root = std::max(1.0 - t, 0.0);
  w.value = root * root;
  if (1.0 - t > -t_rounding) w.rounding = 2.0 * root * t_rounding + t_rounding * t_rounding + 2.0 * kUnit * w.value;
  return w;
}

struct TapWeights {
  Weight diffuse, specular;
};

// bilateral_weight.h by its definitions. The rounding of float: the tangent plane's distance is a difference of terms
// as large as 1 / footprint, of about ten operations each (positions and depths are rounded too).
TapWeights weights_of(const GeometryBuffer& g, std::size_t p, std::size_t q) {
  const double footprint = footprint_of(g), tolerance = 2.0;
  const Double3 from = at3(g.position, p), to = at3(g.position, q);
  const Double3 eye_to = {to[0] - g.camera.eye.x, to[1] - g.camera.eye.y, to[2] - g.camera.eye.z};
  const Double3 apart = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const double scale = 1.0 / (double(g.depth[q]) * footprint * tolerance);
  const double distance = dot3(at3(g.geometric_normal, p), apart) * scale;
  const double distance_rounding =
      10.0 * kUnit * (std::sqrt(dot3(eye_to, eye_to)) + std::sqrt(dot3(from, from))) * scale;
  const double place = distance * distance;
  const double place_rounding =
      2.0 * std::abs(distance) * distance_rounding + distance_rounding * distance_rounding + 4.0 * kUnit;

  const double turned = 1.0 - dot3(at3(g.normal, p), at3(g.normal, q));
  const double diffuse = 1.0 / (1.0 - std::cos(30.0 * 3.14159265358979323846 / 180.0));
  const double angle = std::max(double(g.ggx_alpha[p]), 0.02);
  const double specular = std::max(2.0 / (angle * angle), diffuse);
  const double rougher = 2.0 * double(g.ggx_alpha[q]) / double(g.ggx_alpha[p]) - 2.0;
  TapWeights w;
  const double turn_rounding = 6.0 * kUnit;
  w.diffuse = biweight(place + diffuse * turned, place_rounding + diffuse * turn_rounding);
  w.specular = biweight(place + specular * turned + rougher * rougher,
                        place_rounding + specular * turn_rounding + 16.0 * kUnit * (1.0 + rougher * rougher));
  return w;
}

// What the light of a pixel is divided by; 0 where it must not take part.
double modulation_of(const GeometryBuffer& g, std::size_t at, std::size_t channel) {
  const double left = 1.0 - double(std::max({g.f0[0][at], g.f0[1][at], g.f0[2][at]}));
  return channel < 3 ? std::max(left, 0.0625) : std::max(double(g.f0[channel - 3][at]), 0.02);
}

struct Tap {
  std::size_t at;
  double spatial;
  TapWeights weights;
};

std::vector<Tap> taps_of(const ReferenceFilter& filter, const GeometryBuffer& g, std::size_t p) {
  const int width = static_cast<int>(g.width), height = static_cast<int>(g.height);
  const int px = static_cast<int>(p % g.width), py = static_cast<int>(p / g.width);
  const auto end = [&](int offset, int radius) {
    return radius > 0 && std::abs(offset) == radius ? filter.end_weight : 1.0;
  };
  std::vector<Tap> taps;
  for (int y = std::max(py - filter.radius.y, 0); y <= std::min(py + filter.radius.y, height - 1); ++y) {
    for (int x = std::max(px - filter.radius.x, 0); x <= std::min(px + filter.radius.x, width - 1); ++x) {
      Tap tap;
      tap.at = std::size_t(y) * g.width + std::size_t(x);
      tap.spatial = end(x - px, filter.radius.x) * end(y - py, filter.radius.y);
      if (filter.guided && !(g.depth[tap.at] < kNoSurface)) continue;
      tap.weights = {{1, 0}, {1, 0}};
      if (filter.guided) tap.weights = weights_of(g, p, tap.at);
      taps.push_back(tap);
    }
  }
  return taps;
}

void filter_channel(const ReferenceFilter& filter, const GeometryBuffer& g, const std::vector<Tap>& taps, std::size_t p,
                    std::size_t channel, const Plane& noisy, float& light, float& rounding) {
  const auto weight_of = [&](const Tap& tap) { return channel < 3 ? tap.weights.diffuse : tap.weights.specular; };
  const auto takes_part = [&](const Tap& tap) {
    return !filter.guided || channel >= 3 ||
           1.0f - std::max({g.f0[0][tap.at], g.f0[1][tap.at], g.f0[2][tap.at]}) >= 0.0625f;
  };
  double sum = 0, weights = 0, largest = 0;
  for (const Tap& tap : taps) {
    if (!takes_part(tap)) continue;
    const double w = tap.spatial * weight_of(tap).value, value = noisy[tap.at] / modulation_of(g, tap.at, channel);
    sum += w * value, weights += w, largest = std::max(largest, std::abs(value));
  }
  light = noisy[p], rounding = 0;
  if (!(g.depth[p] < kNoSurface) || weights <= 0) return;
  const double mean = sum / (filter.divide_by_weight ? weights : double(taps.size()));
  double moved = 0;
  for (const Tap& tap : taps) {
    const double value = noisy[tap.at] / modulation_of(g, tap.at, channel);
    if (takes_part(tap)) moved += tap.spatial * weight_of(tap).rounding * std::abs(value - mean);
  }
  // The sums themselves round once per tap.
  const double summing = (double(taps.size()) + 8.0) * kUnit * largest;
  light = static_cast<float>(mean * modulation_of(g, p, channel));
  rounding = static_cast<float>((moved / weights + summing) * modulation_of(g, p, channel));
}

}  // namespace

ReferenceLight filter_by_definition(const ReferenceFilter& filter, const GeometryBuffer& geometry,
                                    const Radiance& noisy) {
  ReferenceLight result;
  resize_light(result.light, geometry.pixel_count());
  resize_light(result.rounding, geometry.pixel_count());
  for (std::size_t p = 0; p < geometry.pixel_count(); ++p) {
    const std::vector<Tap> taps = geometry.depth[p] < kNoSurface ? taps_of(filter, geometry, p) : std::vector<Tap>();
    for (std::size_t channel = 0; channel < 6; ++channel) {
      const std::size_t c = channel % 3;
      const bool diffuse = channel < 3;
      filter_channel(filter, geometry, taps, p, channel, diffuse ? noisy.diffuse[c] : noisy.specular[c],
                     diffuse ? result.light.diffuse[c][p] : result.light.specular[c][p],
                     diffuse ? result.rounding.diffuse[c][p] : result.rounding.specular[c][p]);
    }
  }
  return result;
}

}  // namespace luciole
