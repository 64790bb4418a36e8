// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_culling/light_lists.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "real_time/light_culling/proxy_kernel.h"

namespace luciole {
namespace {

constexpr std::uint32_t kUnits = 64;  // pieces of the work, for the threads: sub-regions, or some lights of one

// Consecutive lights of one sub-region, and where they are found.
struct Unit {
  TileBand band;
  SubsetBounds bounds;
  std::uint32_t first_light, sub_region;
  AlignedVector<LightSpan> spans;
  std::vector<std::size_t> next;  // per tile of the sub-region: how many spans; then where the next one goes
};

TileBand band_of(const LightListInputs& in, std::uint32_t sub_region) {
  const GeometryBuffer& geometry = in.geometry;
  const float n = static_cast<float>(in.interleave), side = static_cast<float>(kTileSide) * n;
  const float sx = static_cast<float>(sub_region % in.interleave), sy = static_cast<float>(sub_region / in.interleave);
  const float pixel = 2 * std::tan(0.5f * geometry.camera.vertical_fov) / static_cast<float>(geometry.height);
  const float border = 0.5f - 0.5f * n;  // of the first tile, from the first pixel of sub-region 0
  TileBand band{};
  band.x_first = (sx + border - 0.5f * static_cast<float>(geometry.width)) * pixel, band.x_step = side * pixel;
  band.y_first = (0.5f * static_cast<float>(geometry.height) - sy - border) * pixel, band.y_step = -side * pixel;
  band.window = in.window, band.columns = in.parts.columns();
  const std::size_t first_tile = std::size_t(sub_region) * in.parts.tiles();
  band.occupied = in.parts.occupied().data() + first_tile, band.first = in.parts.first().data() + first_tile;
  band.slices = in.parts.slices();
  band.test = in.test;
  return band;
}

// Lights are split, not rows of tiles: a light that covers many rows is prepared only once.
std::vector<Unit> units_of(const LightListInputs& in) {
  const std::uint32_t sub_regions = in.interleave * in.interleave, shares = std::max(1u, kUnits / sub_regions);
  std::vector<Unit> units;
  for (std::uint32_t s = 0; s < sub_regions; ++s) {
    const std::uint32_t blocks = (in.bounds[s].count + 15) / 16;
    for (std::uint32_t share = 0; share < shares; ++share) {
      const std::uint32_t begin = blocks * share / shares, end = blocks * (share + 1) / shares;
      if (begin == end) continue;
      const std::uint32_t count = std::min(in.bounds[s].count, end * 16) - begin * 16;
      units.push_back({band_of(in, s), {in.bounds[s].blocks + begin, count}, begin * 16, s, {}, {}});
    }
  }
  return units;
}

// Where units count covered pixels. Those of one sub-region run side by side on the same pixels: each at work has an
// array of its own. Sums of whole numbers do not show which unit had which.
class Coverings {
 public:
  explicit Coverings(std::size_t size) : size_(size) {}

  AlignedVector<float> take() {
    const std::scoped_lock lock(guard_);
    if (idle_.empty()) {
      AlignedVector<float> fresh(size_);
      std::fill(fresh.begin(), fresh.end(), 0.0f);
      return fresh;
    }
    AlignedVector<float> taken = std::move(idle_.back());
    idle_.pop_back();
    return taken;
  }

  void give_back(AlignedVector<float> taken) {
    const std::scoped_lock lock(guard_);
    idle_.push_back(std::move(taken));
  }

  AlignedVector<float> sum() {
    AlignedVector<float> total = take();
    for (const AlignedVector<float>& more : idle_) {
      parallel_for(size_, std::size_t(1) << 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) total[i] += more[i];
      });
    }
    return total;
  }

 private:
  std::size_t size_;
  std::mutex guard_;
  std::vector<AlignedVector<float>> idle_;
};

// Takes the lights of units to their tiles.
class Rasteriser {
 public:
  explicit Rasteriser(const LightListInputs& in)
      : in_(in), coverings_(in.culling == Culling::splatting ? std::size_t(in.parts.count()) * kGroupPixels : 0) {}

  void run(Unit& unit) {
    const TileWindow& w = in_.window;
    const std::size_t tiles = std::size_t(w.column_end - w.column_begin) * (w.row_end - w.row_begin);
    Memory memory;
    memory.low.resize(tiles), memory.high.resize(tiles), memory.found.resize(16 * tiles);
    if (in_.culling == Culling::splatting) memory.covering = coverings_.take();
    unit.next.assign(in_.parts.tiles(), 0);
    for (std::uint32_t b = 0; b * 16 < unit.bounds.count && !too_long() && !stop_requested(); ++b) {
      const std::uint32_t count = spans_of(unit, b, memory);
      for (std::uint32_t i = 0; i < count; ++i) ++unit.next[memory.found[i].tile];
      unit.spans.insert(unit.spans.end(), memory.found.begin(), memory.found.begin() + count);
      entries_ += count;
    }
    if (in_.culling == Culling::splatting) coverings_.give_back(std::move(memory.covering));
    tests_ += memory.tests;
  }

  bool too_long() const {
    const TileWindow& w = in_.window;
    const bool single = w.column_end - w.column_begin == 1 && w.row_end - w.row_begin == 1;
    return !single && entries_ > in_.most_entries;
  }

  AlignedVector<float> covering() { return coverings_.sum(); }
  std::uint64_t tests() const { return tests_; }

 private:
  struct Memory {
    std::vector<float> low, high;
    AlignedVector<LightSpan> found;
    AlignedVector<float> covering;
    std::uint64_t tests = 0;
  };

  std::uint32_t spans_of(const Unit& unit, std::uint32_t b, Memory& m) {
    const BoundBlock& block = unit.bounds.blocks[b];
    const std::uint32_t first_light = unit.first_light + b * 16;
    if (in_.culling == Culling::clustered) {
      return LUCIOLE_FOR_ISA(in_.isa, cluster_lights(block, first_light, unit.band, circumscribed_icosahedron(),
                                                     {m.low.data(), m.high.data()}, m.found.data(), m.tests));
    }
    return LUCIOLE_FOR_ISA(in_.isa, splat_lights(block, first_light, unit.band, circumscribed_geodesic(),
                                                 in_.parts.cells(), m.covering.data(), m.found.data(), m.tests));
  }

  const LightListInputs& in_;
  Coverings coverings_;
  std::atomic<std::size_t> entries_{0};
  std::atomic<std::uint64_t> tests_{0};
};

// Returns the seconds that the calls took, summed over threads.
template <class Body>
double for_each_unit(std::vector<Unit>& units, const Body& body) {
  double busy_seconds = 0;
  std::mutex merging;
  parallel_for(units.size(), 1, [&](std::size_t begin, std::size_t end) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t u = begin; u < end && !stop_requested(); ++u) body(units[u]);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const std::scoped_lock lock(merging);
    busy_seconds += seconds.count();
  });
  return busy_seconds;
}

// Counts become places: tile after tile, and in a tile unit after unit, so that lights ascend.
void lay_out(std::vector<Unit>& units, std::uint32_t tiles, std::vector<std::size_t>& begin) {
  std::size_t place = 0;
  for (std::size_t first = 0, last = 0; first < units.size(); first = last) {
    while (last < units.size() && units[last].sub_region == units[first].sub_region) ++last;
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
      for (std::size_t u = first; u < last; ++u) {
        if (units[u].next.empty()) continue;  // stopped before it began
        const std::size_t count = units[u].next[tile];
        units[u].next[tile] = place, place += count;
      }
      begin[std::size_t(units[first].sub_region) * tiles + tile + 1] = place;
    }
  }
  // Sub-regions without any light.
  for (std::size_t t = 1; t < begin.size(); ++t) begin[t] = std::max(begin[t], begin[t - 1]);
}

template <class Vector>
std::size_t bytes_of(const Vector& values) {
  return values.capacity() * sizeof(values[0]);
}

std::size_t bytes_of(const std::vector<Unit>& units, const LightLists& lists) {
  std::size_t bytes = bytes_of(lists.begin) + bytes_of(lists.light) + bytes_of(lists.parts) + bytes_of(lists.covering);
  for (const Unit& unit : units) bytes += bytes_of(unit.spans) + bytes_of(unit.next);
  return bytes;
}

}  // namespace

LightLists list_lights(const LightListInputs& in) {
  LightLists lists;
  lists.begin.assign(in.parts.occupied().size() + 1, 0);
  std::vector<Unit> units = units_of(in);
  Rasteriser rasteriser(in);
  lists.busy_seconds += for_each_unit(units, [&](Unit& unit) { rasteriser.run(unit); });
  lists.complete = !rasteriser.too_long(), lists.tests = rasteriser.tests();
  if (!lists.complete) return lists;
  if (in.culling == Culling::splatting) lists.covering = rasteriser.covering();
  lay_out(units, in.parts.tiles(), lists.begin);
  lists.light.resize(lists.begin.back()), lists.parts.resize(lists.begin.back());
  lists.bytes = bytes_of(units, lists);
  lists.busy_seconds += for_each_unit(units, [&](Unit& unit) {
    for (const LightSpan& span : unit.spans) {
      const std::size_t at = unit.next[span.tile]++;
      lists.light[at] = span.light, lists.parts[at] = span.parts;
    }
  });
  return lists;
}

}  // namespace luciole
