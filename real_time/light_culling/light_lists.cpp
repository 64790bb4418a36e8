// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_culling/light_lists.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <mutex>
#include <numeric>

#include "base/parallel.h"
#include "real_time/light_culling/proxy_kernel.h"

namespace luciole {
namespace {

constexpr std::uint32_t kUnits = 64;  // pieces of the work, for the threads: a sub-region each, or a band of its rows

// One sub-region's band, and the spans of its lights.
struct Unit {
  TileBand band;
  SubsetBounds bounds;
  AlignedVector<LightSpan> spans;
  std::size_t span_count = 0;
};

TileBand band_of(const LightListInputs& in, std::uint32_t sub_region, std::uint32_t row_begin, std::uint32_t row_end) {
  const GeometryBuffer& geometry = in.geometry;
  const float n = static_cast<float>(in.interleave), side = static_cast<float>(kTileSide) * n;
  const float sx = static_cast<float>(sub_region % in.interleave), sy = static_cast<float>(sub_region / in.interleave);
  const float pixel = 2 * std::tan(0.5f * geometry.camera.vertical_fov) / static_cast<float>(geometry.height);
  const float border = 0.5f - 0.5f * n;  // of the first tile, from the first pixel of sub-region 0
  TileBand band{};
  band.x_first = (sx + border - 0.5f * static_cast<float>(geometry.width)) * pixel, band.x_step = side * pixel;
  band.y_first = (0.5f * static_cast<float>(geometry.height) - sy - border) * pixel, band.y_step = -side * pixel;
  band.columns = in.parts.columns(), band.row_begin = row_begin, band.row_end = row_end;
  const std::size_t first_tile = std::size_t(sub_region) * in.parts.rows() * in.parts.columns();
  band.occupied = in.parts.occupied().data() + first_tile, band.first = in.parts.first().data() + first_tile;
  band.slices = in.parts.slices();
  band.test = in.test;
  return band;
}

std::vector<Unit> units_of(const LightListInputs& in) {
  const std::uint32_t sub_regions = in.interleave * in.interleave, rows = in.parts.rows();
  const std::uint32_t bands = std::min(rows, std::max(1u, kUnits / sub_regions));
  std::vector<Unit> units;
  for (std::uint32_t s = 0; s < sub_regions; ++s) {
    for (std::uint32_t b = 0; b < bands; ++b) {
      units.push_back({band_of(in, s, rows * b / bands, rows * (b + 1) / bands), in.bounds[s], {}});
    }
  }
  return units;
}

// Takes the lights of a unit to its tiles.
class Rasteriser {
 public:
  Rasteriser(const LightListInputs& in, LightLists& lists) : in_(in), lists_(lists) {}

  void run(Unit& unit) {
    const std::size_t tiles = std::size_t(unit.band.columns) * (unit.band.row_end - unit.band.row_begin);
    low_.resize(tiles), high_.resize(tiles);
    bits_.assign(tiles * kGroupPixels, 0);
    for (std::uint32_t b = 0; b * 16 < unit.bounds.count; ++b) {
      const std::size_t enough = unit.span_count + 16 * tiles;
      if (unit.spans.size() < enough) unit.spans.resize(std::max(2 * unit.spans.size(), enough));
      unit.span_count += spans_of(unit, unit.bounds.blocks[b], b * 16, unit.spans.data() + unit.span_count);
    }
  }

 private:
  std::uint32_t spans_of(const Unit& unit, const BoundBlock& block, std::uint32_t first_light, LightSpan* spans) {
    if (in_.culling == Culling::clustered) {
      return LUCIOLE_FOR_ISA(in_.isa, cluster_lights(block, first_light, unit.band, circumscribed_icosahedron(),
                                                     {low_.data(), high_.data()}, spans));
    }
    return LUCIOLE_FOR_ISA(
        in_.isa, splat_lights(block, first_light, unit.band, circumscribed_geodesic(), in_.parts.cells().data(),
                              lists_.covering.data(), bits_.data(), spans));
  }

  const LightListInputs& in_;
  LightLists& lists_;
  std::vector<float> low_, high_;
  std::vector<std::uint16_t> bits_;
};

// visit(part, light) for all entries of a unit, lights ascending.
template <class Visit>
void for_each_entry(const Unit& unit, const Visit& visit) {
  for (std::size_t i = 0; i < unit.span_count; ++i) {
    const LightSpan& span = unit.spans[i];
    for (std::uint32_t left = span.parts; left != 0; left &= left - 1) {
      const std::uint32_t below = unit.band.occupied[span.tile] & ((left & -left) - 1);
      visit(unit.band.first[span.tile] + static_cast<std::uint32_t>(std::popcount(below)), span.light);
    }
  }
}

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

}  // namespace

LightLists list_lights(const LightListInputs& in) {
  LightLists lists;
  lists.begin.assign(std::size_t(in.parts.count()) + 1, 0);
  if (in.culling == Culling::splatting) {
    lists.covering.resize(std::size_t(in.parts.count()) * kGroupPixels);
    std::fill(lists.covering.begin(), lists.covering.end(), 0.0f);
  }
  if (in.parts.count() == 0) return lists;
  std::vector<Unit> units = units_of(in);
  // No two units have a part in common.
  lists.busy_seconds += for_each_unit(units, [&](Unit& unit) {
    Rasteriser(in, lists).run(unit);
    for_each_entry(unit, [&](std::uint32_t part, std::uint32_t) { ++lists.begin[part + 1]; });
  });
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  lists.index.resize(lists.begin.back());
  std::vector<std::size_t> next = lists.begin;
  lists.busy_seconds += for_each_unit(units, [&](Unit& unit) {
    for_each_entry(unit, [&](std::uint32_t part, std::uint32_t light) { lists.index[next[part]++] = light; });
  });
  return lists;
}

}  // namespace luciole
