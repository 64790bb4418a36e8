// SPDX-License-Identifier: Apache-2.0
#include "real_time/not_finite.h"

#include <atomic>
#include <cmath>

#include "base/parallel.h"

namespace luciole {
namespace {

constexpr std::size_t kGrain = 65536;  // pixels

// How many pixels are bad.
template <class IsBad>
std::uint64_t count_pixels(std::size_t pixels, const IsBad& is_bad) {
  std::atomic<std::uint64_t> total{0};
  parallel_for(pixels, kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint64_t count = 0;
    for (std::size_t i = begin; i < end; ++i) count += is_bad(i) ? 1 : 0;
    total += count;
  });
  return total;
}

}  // namespace

std::uint64_t count_not_finite(const Radiance& light) {
  const Plane3 &d = light.diffuse, &s = light.specular;
  return count_pixels(d[0].size(), [&](std::size_t i) {
    // Zero times what is not finite is no number; a sum of large values alone might leave the range.
    const float probe = 0 * d[0][i] + 0 * d[1][i] + 0 * d[2][i] + 0 * s[0][i] + 0 * s[1][i] + 0 * s[2][i];
    return probe != 0;
  });
}

std::uint64_t blacken_not_finite(std::vector<Vec3>& picture) {
  return count_pixels(picture.size(), [&](std::size_t i) {
    Vec3& pixel = picture[i];
    if (std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z)) return false;
    pixel = {0, 0, 0};
    return true;
  });
}

}  // namespace luciole
