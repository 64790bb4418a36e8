// SPDX-License-Identifier: Apache-2.0
#include "real_time/sky_light/sky_light.h"

#include <algorithm>
#include <vector>

#include "base/fold_seed.h"
#include "equations/cpp/float.h"
#include "scene/sky.h"

namespace luciole {
namespace {

constexpr std::uint32_t kDimensionSky = 16;

double luminance_of(Vec3 rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

// Running sums of luminance times solid angle over the texels, row by row.
std::vector<double> cumulated(const Environment& environment) {
  std::vector<double> sums(environment.pixels.size());
  double sum = 0;
  for (std::uint32_t row = 0; row < environment.height; ++row) {
    const double solid_angle = sky_texel_solid_angle(environment, row);
    for (std::uint32_t column = 0; column < environment.width; ++column) {
      const std::size_t i = std::size_t(row) * environment.width + column;
      sum += std::max(luminance_of(environment.radiance * environment.pixels[i]), 0.0) * solid_angle;
      sums[i] = sum;
    }
  }
  return sums;
}

struct UnitNumbers {
  double a, b, c;
};

// Three numbers in [0,1) for one stratum; the middle without jitter and seed.
UnitNumbers numbers_of(const SkySampling& sampling, std::uint32_t stratum) {
  if (sampling.seed == 0 && !sampling.jitter) return {0.5, 0.5, 0.5};
  const std::uint32_t frame = sampling.jitter ? folded(sampling.frame) : 0;
  const auto unit = [](std::uint32_t bits) { return bits * 0x1p-32; };
  const f32::RandomWords first = f32::random_words(folded(sampling.seed), frame, stratum, kDimensionSky);
  const f32::RandomWords more = f32::random_words(folded(sampling.seed), frame, stratum, kDimensionSky + 1);
  return {unit(first.first), unit(first.second), unit(more.first)};
}

}  // namespace

PrimaryLights sample_sky(const Environment& environment, const SkySampling& sampling) {
  if (environment.pixels.empty() || sampling.lights == 0) return {};
  const std::vector<double> sums = cumulated(environment);
  const double total = sums.back();
  if (!(total > 0)) return {};
  PrimaryLights lights;
  for (std::uint32_t k = 0; k < sampling.lights; ++k) {
    const UnitNumbers u = numbers_of(sampling, k);
    const double wanted = total * (k + u.a) / sampling.lights;
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, wanted);
    const auto texel = static_cast<std::size_t>(found - sums.begin());
    const Vec3 radiance = environment.radiance * environment.pixels[texel];
    PunctualLight light;
    light.kind = PunctualLight::Kind::directional;
    light.name = "sky";
    light.direction = -sky_direction(environment, texel, u.b, u.c);
    // L / pdf / lights with pdf = luminance / total [1/sr].
    light.intensity = radiance * static_cast<float>(total / (luminance_of(radiance) * sampling.lights));
    lights.push_back(light);
  }
  return lights;
}

}  // namespace luciole
