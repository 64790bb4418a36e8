// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/list_worker.h"

#include <algorithm>
#include <bit>
#include <chrono>

namespace luciole {
namespace {

template <class Emitter>
LightLists lists_of(const ShadingInputs& inputs, const TileParts& parts, const TileWindow& window,
                    const ReachingLights<Emitter>& lights) {
  if (lights.emitters.empty()) return {};
  const Settings& settings = inputs.settings;
  const std::uint32_t subsets = settings.interleave * settings.interleave;
  std::vector<SubsetBounds> bounds;
  for (std::uint32_t s = 0; s < subsets; ++s) {
    const std::uint32_t subset = (s + inputs.shift) % subsets;
    bounds.push_back({lights.bounds.data() + lights.begin[subset] / 16, lights.count[subset]});
  }
  return list_lights({inputs.geometry, parts, std::move(bounds), settings.interleave, settings.culling,
                      settings.tile_test, settings.isa, window, inputs.most_entries});
}

}  // namespace

PartLists::PartLists(const ShadingInputs& inputs, const TileParts& parts, const TileWindow& window)
    : parts_(parts),
      diffuse_(lists_of(inputs, parts_, window, inputs.diffuse)),
      glossy_(lists_of(inputs, parts_, window, inputs.glossy)),
      many_(lists_of(inputs, parts_, window, inputs.many)) {}

double PartLists::busy_seconds() const { return diffuse_.busy_seconds + glossy_.busy_seconds + many_.busy_seconds; }

void ListWorker::list_parts(const LightLists& lists, std::uint32_t tile) {
  const std::size_t begin = lists.begin[tile], count = lists.begin[tile + 1] - begin;
  const std::uint32_t occupied = lists_.parts().occupied()[tile];
  const std::size_t most = std::size_t(std::popcount(occupied)) * count + 1;
  if (index_.size() < most) index_.resize(most);
  part_begin_.assign(1, 0);
  std::uint32_t* place = index_.data();
  for (std::uint32_t left = occupied; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    for (std::size_t i = begin; i < begin + count; ++i) {
      *place = lists.light[i];
      place += lists.parts[i] >> bit & 1u;
    }
    part_begin_.push_back(static_cast<std::size_t>(place - index_.data()));
  }
}

template <class Emitter>
void ListWorker::add_lights(const ReachingLights<Emitter>& lights, const LightLists& lists, TileSeen seen,
                            LightCounts& added, Radiance& radiance, Radiance* part) {
  if (lights.emitters.empty()) return;
  const auto start = std::chrono::steady_clock::now();
  list_parts(lists, seen.tile);
  const auto listed = std::chrono::steady_clock::now();
  const Emitter* emitters = lights.emitters.data() + lights.begin[seen.subset];
  for (std::uint32_t g = 0; g < tile_.group_count; ++g) {
    const PixelGroup& group = tile_.groups[g];
    const std::uint32_t p = group.part - lists_.parts().first()[seen.tile];
    const auto length = static_cast<std::uint32_t>(part_begin_[p + 1] - part_begin_[p]);
    if (g == 0 || group.part != tile_.groups[g - 1].part) counts.list_lengths.push_back(length);
    if (lists.covering.empty()) {
      std::fill(listed_, listed_ + kGroupPixels, static_cast<float>(length));
    } else {
      std::copy_n(lists.covering.data() + std::size_t(group.part) * kGroupPixels, kGroupPixels, listed_);
    }
    const LightList<Emitter> list{emitters, index_.data() + part_begin_[p], length, nullptr};
    shader_.add(group, list, listed_, added, radiance, part);
  }
  counts.culling_seconds += std::chrono::duration<double>(listed - start).count();
  counts.shading_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - listed).count();
}

void ListWorker::run_block(std::uint32_t bx, std::uint32_t by) {
  const std::uint32_t n = inputs_.settings.interleave;
  for (std::uint32_t s = 0; s < n * n; ++s) {
    const auto start = std::chrono::steady_clock::now();
    const TileAddress address{n, bx, by, s % n, s / n};
    lists_.parts().read(address, tile_);
    counts.shading_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (std::uint32_t g = 0; g < tile_.group_count; ++g) counts.pixels += tile_.groups[g].count;
    const TileSeen seen{lists_.parts().tile(address), (s + inputs_.shift) % (n * n)};
    ShadedRadiance& radiance = outputs_.radiance;
    const bool apart = inputs_.lobes_apart;
    add_lights(inputs_.diffuse, lists_.diffuse(), seen, counts.diffuse, radiance.indirect,
               apart ? &radiance.from_diffuse : nullptr);
    add_lights(inputs_.glossy, lists_.glossy(), seen, counts.glossy, radiance.indirect,
               apart ? &radiance.from_glossy : nullptr);
    add_lights(inputs_.many, lists_.many(), seen, counts.many, radiance.from_many);
  }
}

}  // namespace luciole
