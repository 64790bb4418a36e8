// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/list_worker.h"

#include <algorithm>
#include <chrono>

namespace luciole {
namespace {

template <class Emitter>
LightLists lists_of(const ShadingInputs& inputs, const TileParts& parts, const ReachingLights<Emitter>& lights) {
  if (lights.emitters.empty()) return {};
  const Settings& settings = inputs.settings;
  const std::uint32_t subsets = settings.interleave * settings.interleave;
  std::vector<SubsetBounds> bounds;
  for (std::uint32_t s = 0; s < subsets; ++s) {
    const std::uint32_t subset = (s + inputs.shift) % subsets;
    bounds.push_back({lights.bounds.data() + lights.begin[subset] / 16, lights.count[subset]});
  }
  return list_lights({inputs.geometry, parts, std::move(bounds), settings.interleave, settings.culling,
                      settings.tile_test, settings.isa});
}

}  // namespace

PartLists::PartLists(const ShadingInputs& inputs)
    : parts_(inputs.geometry, inputs.settings.interleave, inputs.settings.culling),
      diffuse_(lists_of(inputs, parts_, inputs.diffuse)),
      glossy_(lists_of(inputs, parts_, inputs.glossy)),
      many_(lists_of(inputs, parts_, inputs.many)) {}

double PartLists::busy_seconds() const {
  return parts_.busy_seconds() + diffuse_.busy_seconds + glossy_.busy_seconds + many_.busy_seconds;
}

template <class Emitter>
void ListWorker::add_lights(const ReachingLights<Emitter>& lights, const LightLists& lists, std::uint32_t subset,
                            LightCounts& added, Radiance& radiance, Radiance* part) {
  if (lights.emitters.empty()) return;
  const Emitter* emitters = lights.emitters.data() + lights.begin[subset];
  for (std::uint32_t g = 0; g < tile_.group_count; ++g) {
    const PixelGroup& group = tile_.groups[g];
    const std::uint32_t length = lists.length(group.part);
    if (g == 0 || group.part != tile_.groups[g - 1].part) counts.list_lengths.push_back(length);
    if (lists.covering.empty()) {
      std::fill(listed_, listed_ + kGroupPixels, static_cast<float>(length));
    } else {
      std::copy_n(lists.covering.data() + std::size_t(group.part) * kGroupPixels, kGroupPixels, listed_);
    }
    const LightList<Emitter> list{emitters, lists.index.data() + lists.begin[group.part], length, nullptr};
    shader_.add(group, list, listed_, added, radiance, part);
  }
}

void ListWorker::run_block(std::uint32_t bx, std::uint32_t by) {
  const auto start = std::chrono::steady_clock::now();
  const std::uint32_t n = inputs_.settings.interleave;
  for (std::uint32_t s = 0; s < n * n; ++s) {
    lists_.parts().read({n, bx, by, s % n, s / n}, tile_);
    for (std::uint32_t g = 0; g < tile_.group_count; ++g) counts.pixels += tile_.groups[g].count;
    const std::uint32_t subset = (s + inputs_.shift) % (n * n);
    ShadedRadiance& radiance = outputs_.radiance;
    const bool apart = inputs_.lobes_apart;
    add_lights(inputs_.diffuse, lists_.diffuse(), subset, counts.diffuse, radiance.indirect,
               apart ? &radiance.from_diffuse : nullptr);
    add_lights(inputs_.glossy, lists_.glossy(), subset, counts.glossy, radiance.indirect,
               apart ? &radiance.from_glossy : nullptr);
    add_lights(inputs_.many, lists_.many(), subset, counts.many, radiance.from_many);
  }
  counts.shading_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace luciole
