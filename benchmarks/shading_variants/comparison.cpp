// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/shading_variants/comparison.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace luciole {
namespace {

bool same_light(const PixelSums& a, const PixelSums& b) {
  return std::memcmp(a.diffuse, b.diffuse, sizeof(a.diffuse)) == 0 &&
         std::memcmp(a.specular, b.specular, sizeof(a.specular)) == 0 && a.accepted == b.accepted;
}

// Terms are not negative, so each of two orders of n of them errs by (n - 1) half units in the last place at most.
double in_roundings(double a, double b, std::uint32_t terms) {
  constexpr double kHalfUnit = 0x1p-24;
  if (a == b) return 0;
  return std::abs(a - b) / (2 * kHalfUnit * std::max(1.0, double(terms) - 1) * std::max(a, b));
}

}  // namespace

Comparison compare(const GeometryBuffer& geometry, const std::vector<PixelSums>& engine,
                   const std::vector<PixelSums>& found) {
  Comparison c;
  double squares = 0, differences = 0;
  for (std::size_t i = 0; i < engine.size(); ++i) {
    if (geometry.depth[i] == kNoSurface) continue;
    const PixelSums &a = engine[i], &b = found[i];
    c.accepted += a.accepted;
    c.same_bits = c.same_bits && same_light(a, b);
    if (a.accepted != b.accepted) {
      ++c.other_lights;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const double albedo = geometry.diffuse_albedo[k][i];
      const double value = a.diffuse[k] * albedo + a.specular[k], other = b.diffuse[k] * albedo + b.specular[k];
      squares += value * value, differences += (other - value) * (other - value);
      c.largest_in_roundings = std::max({c.largest_in_roundings, in_roundings(a.diffuse[k], b.diffuse[k], a.accepted),
                                         in_roundings(a.specular[k], b.specular[k], a.accepted)});
    }
  }
  c.relative_mse = squares > 0 ? differences / squares : differences;
  return c;
}

// Schlick's weight is a fifth power of a rounded number in three products; one minus it, two products, two rounded
// reflectances and a sum follow: 17 roundings of 2^-11 if all of them stood at their worst.
double most_of_half_precision() {
  constexpr double kRoundings = 17;
  return kRoundings * kRoundings * 0x1p-22;
}

std::string complaint(const Comparison& c) {
  // A tie is |p / xi - 1| < 10^-5, as in real_time/double_reference.h: of uniform xi that happens to 2 10^-5 p lights,
  // and the sum of all p is what is accepted on average.
  const double ties = 2e-5 * c.accepted;
  if (double(c.other_lights) > ties + 5 * std::sqrt(ties) + 1) {
    return std::to_string(c.other_lights) + " pixels accepted other lights";
  }
  if (!(c.relative_mse <= most_of_half_precision())) {
    return "its relative mean square error is " + std::to_string(c.relative_mse);
  }
  return {};
}

std::string broken_promise(const Comparison& c, Agreement agreement) {
  if (agreement == Agreement::bits) return c.same_bits ? "" : "bits differ";
  if (c.other_lights > 0) return std::to_string(c.other_lights) + " pixels accepted other lights";
  if (agreement == Agreement::rounding && !(c.largest_in_roundings <= 1)) return "more than another order differs";
  return c.relative_mse <= most_of_half_precision() ? "" : "more than half precision differs";
}

}  // namespace luciole
