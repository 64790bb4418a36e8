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

// All but FLIP.
MappedComparison compare_linear(const std::vector<Vec3>& picture, const std::vector<Vec3>& reference, float exposure) {
  const double reference_mean = mean_of(reference);
  const double count = 3.0 * static_cast<double>(reference.size());
  MappedComparison result;
  double squares = 0, relative_squares = 0, displayed_squares = 0;
  const auto displayed = [exposure](double value) { return std::clamp(value * exposure, 0.0, 1.0); };
  // Gives the relative square of one value.
  const auto add = [&](double x, double r) {
    const double difference = x - r;
    squares += difference * difference;
    displayed_squares += (displayed(x) - displayed(r)) * (displayed(x) - displayed(r));
    result.figures.largest_difference = std::max(result.figures.largest_difference, std::abs(difference));
    return ratio(difference * difference, r * r + 0.01 * reference_mean * reference_mean, 0);
  };
  result.maps.relative_error.reserve(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double red = add(picture[i].x, reference[i].x);
    const double green = add(picture[i].y, reference[i].y);
    const double blue = add(picture[i].z, reference[i].z);
    relative_squares += red + green + blue;
    result.maps.relative_error.push_back(static_cast<float>(std::sqrt((red + green + blue) / 3)));
  }
  result.figures.rmse = std::sqrt(squares / count);
  result.figures.display_rmse = std::sqrt(displayed_squares / count);
  result.figures.relmse = relative_squares / count;
  result.figures.mean_ratio = ratio(mean_of(picture), reference_mean, 1);
  return result;
}

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

}  // namespace

Status check_comparable(const Image& picture) {
  const std::vector<Vec3> pixels = picture.colours("");
  if (pixels.empty()) return cannot_compare("a picture without channels R, G, B");
  if (!all_finite(pixels)) return cannot_compare("a picture has values that are not finite");
  return Done{};
}

Result<MappedComparison> compare_with_maps(const Image& picture, const Image& reference,
                                           const ComparisonSettings& settings) {
  if (picture.width != reference.width || picture.height != reference.height) {
    return cannot_compare("the pictures differ in size (" + size_text(picture) + " and " + size_text(reference) + ")");
  }
  for (const Image* image : {&picture, &reference}) {
    if (Status status = check_comparable(*image); !status) return status.error();
  }
  const std::vector<Vec3> x = picture.colours(""), r = reference.colours("");
  MappedComparison result = compare_linear(x, r, settings.exposure);
  const auto displayed = [&](const std::vector<Vec3>& pixels) {
    return to_display(pixels, settings.exposure, settings.tone_curve);
  };
  result.maps.flip =
      flip_map(displayed(x), displayed(r), reference.width, reference.height, settings.pixels_per_degree);
  double sum = 0;
  for (const float difference : result.maps.flip) sum += difference;
  result.figures.flip = sum / static_cast<double>(result.maps.flip.size());
  return result;
}

Result<Comparison> compare(const Image& picture, const Image& reference, const ComparisonSettings& settings) {
  const Result<MappedComparison> compared = compare_with_maps(picture, reference, settings);
  if (!compared) return compared.error();
  return compared->figures;
}

}  // namespace luciole
