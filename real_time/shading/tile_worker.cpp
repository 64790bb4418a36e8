// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/tile_worker.h"

#include <algorithm>
#include <chrono>
#include <numeric>

namespace luciole {
namespace {

constexpr std::uint32_t kSlack = 16;  // kernels write whole registers past the end of a list

}  // namespace

TileFrustum frustum_of(const ScreenTile& tile) {
  TileFrustum f{};
  bool first = true;
  for (const TileHalf& half : tile.half) {
    if (half.pixels == 0) continue;
    f.x_low = first ? half.x0 : std::min(f.x_low, half.x0), f.x_high = first ? half.x1 : std::max(f.x_high, half.x1);
    f.y_low = first ? half.y0 : std::min(f.y_low, half.y0), f.y_high = first ? half.y1 : std::max(f.y_high, half.y1);
    first = false;
  }
  const bool has_near = tile.half[0].pixels > 0, has_far = tile.half[1].pixels > 0;
  f.near_low = has_near ? tile.half[0].z0 : 1.0f, f.near_high = has_near ? tile.half[0].z1 : 0.0f;
  f.far_low = has_far ? tile.half[1].z0 : 1.0f, f.far_high = has_far ? tile.half[1].z1 : 0.0f;
  return f;
}

TouchingLights& ListMemory::reserve(std::size_t lights) {
  if (index_.size() < lights + kSlack) {
    index_.resize(lights + kSlack);
    for (auto& row : rows_) row.resize(lights + kSlack);
  }
  lists_.index = index_.data();
  for (int r = 0; r < TouchingLights::kRows; ++r) lists_.row[r] = rows_[r].data();
  lists_.count = 0;
  return lists_;
}

template <class Emitter>
void TileWorker::list_lights(const ReachingLights<Emitter>& lights, std::uint32_t subset, LightCounts& added) {
  const std::uint32_t count = lights.count[subset];
  TouchingLights& near_half = halves_[0].reserve(count);
  TouchingLights& far_half = halves_[1].reserve(count);
  if (inputs_.settings.culling == Culling::none) {
    // Both halves see the whole subset.
    for (TouchingLights* half : {&near_half, &far_half}) {
      std::iota(half->index, half->index + count, 0u);
      half->count = count;
    }
    return;
  }
  added.tests += count;
  const BoundBlock* blocks = lights.bounds.data() + lights.begin[subset] / 16;
  const TileFrustum frustum = frustum_of(tile_);
  LUCIOLE_FOR_ISA(inputs_.settings.isa,
                  cull_tile(blocks, (count + 15) / 16, frustum, inputs_.settings.tile_test, near_half, far_half));
}

void TileWorker::list_lights_of_groups(std::uint32_t subset_lights, LightCounts& added) {
  group_begin_.assign(1, 0u);
  for (std::uint32_t g = 0; g < tile_.group_count; ++g) {
    const PixelGroup& group = tile_.groups[g];
    const TouchingLights& lights = halves_[group.part].lists();
    const std::uint32_t begin = group_begin_.back();
    if (group_lists_.size() < begin + subset_lights + kSlack) {
      group_lists_.resize(std::max(2 * group_lists_.size(), std::size_t(begin) + subset_lights + kSlack));
    }
    std::uint32_t* list = group_lists_.data() + begin;
    std::uint32_t count = lights.count;
    // The group test is ours: the paper's lists are shaded as they are.
    if (inputs_.settings.culling == Culling::none || inputs_.settings.tile_test == TileTest::paper) {
      std::copy(lights.index, lights.index + count, list);
    } else {
      added.tests += count;
      count = LUCIOLE_FOR_ISA(inputs_.settings.isa, cull_group(lights, group, list));
    }
    group_begin_.push_back(begin + count);
  }
}

template <class Emitter>
void TileWorker::add_lights(const ReachingLights<Emitter>& lights, std::uint32_t subset, LightCounts& added,
                            Radiance& radiance, Radiance* part) {
  if (lights.emitters.empty()) return;
  const auto start = std::chrono::steady_clock::now();
  list_lights(lights, subset, added);
  list_lights_of_groups(lights.count[subset], added);
  for (int half = 0; half < 2; ++half)
    if (tile_.half[half].pixels > 0) counts.list_lengths.push_back(halves_[half].lists().count);
  const auto listed = std::chrono::steady_clock::now();
  const Emitter* emitters = lights.emitters.data() + lights.begin[subset];
  for (std::uint32_t g = 0; g < tile_.group_count; ++g) {
    const PixelGroup& group = tile_.groups[g];
    const LightList<Emitter> list{emitters, group_lists_.data() + group_begin_[g],
                                  group_begin_[g + 1] - group_begin_[g], nullptr};
    std::fill(listed_, listed_ + kGroupPixels, static_cast<float>(halves_[group.part].lists().count));
    shader_.add(group, list, listed_, added, radiance, part);
  }
  counts.culling_seconds += std::chrono::duration<double>(listed - start).count();
  counts.shading_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - listed).count();
}

void TileWorker::run_block(std::uint32_t bx, std::uint32_t by) {
  const std::uint32_t n = inputs_.settings.interleave;
  for (std::uint32_t s = 0; s < n * n; ++s) {
    const auto start = std::chrono::steady_clock::now();
    read_tile(inputs_.geometry, {n, bx, by, s % n, s / n}, tile_);
    counts.shading_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (tile_.group_count == 0) continue;
    counts.pixels += tile_.half[0].pixels + tile_.half[1].pixels;
    const std::uint32_t subset = (s + inputs_.shift) % (n * n);
    ShadedRadiance& radiance = outputs_.radiance;
    const bool apart = inputs_.lobes_apart;
    add_lights(inputs_.diffuse, subset, counts.diffuse, radiance.indirect, apart ? &radiance.from_diffuse : nullptr);
    add_lights(inputs_.glossy, subset, counts.glossy, radiance.indirect, apart ? &radiance.from_glossy : nullptr);
    add_lights(inputs_.many, subset, counts.many, radiance.from_many);
  }
}

}  // namespace luciole
