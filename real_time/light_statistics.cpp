// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_statistics.h"

#include <algorithm>

namespace luciole {

void count_lights(const ShadingOutputs& shaded, FrameStatistics& statistics) {
  const double pixels = std::max<double>(1.0, static_cast<double>(shaded.pixels));
  const auto per_pixel = [&](auto count) {
    return PerPixel{count(shaded.diffuse) / pixels, count(shaded.glossy) / pixels, count(shaded.many) / pixels};
  };
  statistics.tests = per_pixel([](const LightCounts& c) { return static_cast<double>(c.tests); });
  statistics.listed = per_pixel([](const LightCounts& c) { return static_cast<double>(c.listed); });
  statistics.accepted = per_pixel([](const LightCounts& c) { return static_cast<double>(c.accepted); });
  statistics.false_positives =
      per_pixel([](const LightCounts& c) { return static_cast<double>(c.listed - c.accepted); });
  statistics.evaluated = per_pixel([](const LightCounts& c) { return static_cast<double>(c.evaluated); });
  std::vector<std::uint32_t> lengths = shaded.list_lengths;
  if (lengths.empty()) return;
  double sum = 0;
  for (std::uint32_t length : lengths) sum += length;
  const auto p99 = lengths.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(lengths.size() - 1));
  std::nth_element(lengths.begin(), p99, lengths.end());
  statistics.list_length_p99 = *p99;
  statistics.list_length_mean = sum / static_cast<double>(lengths.size());
  statistics.list_length_max = *std::max_element(lengths.begin(), lengths.end());
}

double listed_pairs(const ShadingOutputs& shaded) {
  return static_cast<double>(shaded.diffuse.listed + shaded.glossy.listed + shaded.many.listed);
}

void time_shading(const ShadingOutputs& shaded, double wall_ms, FrameStatistics& statistics) {
  const double busy = std::max(shaded.culling_seconds + shaded.shading_seconds, 1e-9);
  statistics.passes_ms.emplace_back("culling", wall_ms * shaded.culling_seconds / busy);
  statistics.passes_ms.emplace_back("shading", wall_ms * shaded.shading_seconds / busy);
  statistics.evaluations_per_second = listed_pairs(shaded) / std::max(wall_ms * 1e-3, 1e-9);
}

}  // namespace luciole
