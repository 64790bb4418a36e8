// SPDX-License-Identifier: Apache-2.0
#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luciole {
namespace {

Error cannot_compare(const std::string& reason) { return Error{ErrorKind::failed, "cannot compare: " + reason}; }

bool all_finite(const std::vector<Vec3>& pixels) {
  return std::all_of(pixels.begin(), pixels.end(), [](const Vec3& pixel) {
    return std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z);
  });
}

double mean_of(const std::vector<Vec3>& pixels) {
  double sum = 0;
  for (const Vec3& pixel : pixels) sum += double(pixel.x) + pixel.y + pixel.z;
  return sum / (3.0 * static_cast<double>(pixels.size()));
}

// 0/0 is what equal pictures give: `equal`.
double ratio(double numerator, double denominator, double equal) {
  if (denominator != 0) return numerator / denominator;
  return numerator == 0 ? equal : std::numeric_limits<double>::infinity();
}

Comparison compare_linear(const std::vector<Vec3>& picture, const std::vector<Vec3>& reference) {
  const double reference_mean = mean_of(reference);
  const double count = 3.0 * static_cast<double>(reference.size());
  Comparison result;
  double squares = 0, relative_squares = 0;
  const auto add = [&](double x, double r) {
    const double difference = x - r;
    squares += difference * difference;
    relative_squares += ratio(difference * difference, r * r + 0.01 * reference_mean * reference_mean, 0);
    result.largest_difference = std::max(result.largest_difference, std::abs(difference));
  };
  for (std::size_t i = 0; i < reference.size(); ++i) {
    add(picture[i].x, reference[i].x);
    add(picture[i].y, reference[i].y);
    add(picture[i].z, reference[i].z);
  }
  result.rmse = std::sqrt(squares / count);
  result.relmse = relative_squares / count;
  result.mean_ratio = ratio(mean_of(picture), reference_mean, 1);
  return result;
}

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

}  // namespace

Result<Comparison> compare(const Image& picture, const Image& reference, const ComparisonSettings& settings) {
  if (picture.width != reference.width || picture.height != reference.height) {
    return cannot_compare("the pictures differ in size (" + size_text(picture) + " and " + size_text(reference) + ")");
  }
  const std::vector<Vec3> x = picture.colours(""), r = reference.colours("");
  if (x.empty() || r.empty()) return cannot_compare("a picture without channels R, G, B");
  if (!all_finite(x) || !all_finite(r)) return cannot_compare("a picture has values that are not finite");
  Comparison result = compare_linear(x, r);
  const auto displayed = [&](const std::vector<Vec3>& pixels) {
    return to_display(pixels, settings.exposure, settings.tone_curve);
  };
  const std::vector<float> map =
      flip_map(displayed(x), displayed(r), reference.width, reference.height, settings.pixels_per_degree);
  double sum = 0;
  for (const float difference : map) sum += difference;
  result.flip = sum / static_cast<double>(map.size());
  return result;
}

}  // namespace luciole
