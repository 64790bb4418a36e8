// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_culling/tile_parts.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <limits>
#include <mutex>
#include <numeric>

#include "base/parallel.h"

namespace luciole {
namespace {

constexpr std::uint32_t kPartsOfTile = 32;  // the most: clusters have as many, cells 16

constexpr float kNoPixel = std::numeric_limits<float>::quiet_NaN();

struct DepthRange {
  float nearest = kNoSurface, farthest = 0;
};

DepthRange depth_range(const Plane& depth) {
  DepthRange all;
  std::mutex merging;
  parallel_for(depth.size(), std::size_t(1) << 16, [&](std::size_t begin, std::size_t end) {
    DepthRange here;
    for (std::size_t i = begin; i < end; ++i) {
      if (depth[i] == kNoSurface) continue;
      here.nearest = std::min(here.nearest, depth[i]), here.farthest = std::max(here.farthest, depth[i]);
    }
    const std::scoped_lock lock(merging);
    all.nearest = std::min(all.nearest, here.nearest), all.farthest = std::max(all.farthest, here.farthest);
  });
  return all;
}

}  // namespace

TileParts::TileParts(const GeometryBuffer& geometry, std::uint32_t interleave, Culling culling)
    : geometry_(geometry), interleave_(interleave), clusters_(culling == Culling::clustered) {
  const std::uint32_t side = kTileSide * interleave;
  columns_ = (geometry.width + side - 1) / side, rows_ = (geometry.height + side - 1) / side;
  const DepthRange range = depth_range(geometry.depth);
  if (range.farthest > 0) slices_ = cluster_slices_between(range.nearest, range.farthest);
  const std::size_t tiles = std::size_t(columns_) * rows_ * interleave * interleave;
  occupied_.resize(tiles), first_.resize(tiles);
  for_each_tile([this](const TileAddress& at) { find_occupied(at); });
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    first_[tile] = count_;
    count_ += static_cast<std::uint32_t>(std::popcount(occupied_[tile]));
  }
  if (clusters_) return;
  cells_.resize(count_), nearest_.resize(count_);
  for_each_tile([this](const TileAddress& at) { fill_cells(at); });
}

// Block by block, as the sub-regions of a block share cache lines.
template <class Visit>
void TileParts::for_each_tile(const Visit& visit) {
  const std::uint32_t n = interleave_;
  std::mutex merging;
  parallel_for(std::size_t(columns_) * rows_, 1, [&](std::size_t begin, std::size_t end) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t block = begin; block < end; ++block) {
      const auto bx = static_cast<std::uint32_t>(block % columns_), by = static_cast<std::uint32_t>(block / columns_);
      for (std::uint32_t s = 0; s < n * n; ++s) visit({n, bx, by, s % n, s / n});
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const std::scoped_lock lock(merging);
    busy_seconds_ += seconds.count();
  });
}

std::uint32_t TileParts::tile(const TileAddress& at) const {
  return ((at.sy * interleave_ + at.sx) * rows_ + at.by) * columns_ + at.bx;
}

std::uint32_t TileParts::part_in_tile(const TilePixel& pixel) const {
  return clusters_ ? cluster_slice_of(slices_, pixel.view.z) : pixel.cell;
}

// Reads depths alone, a quarter of what list_pixels does.
void TileParts::find_occupied(const TileAddress& at) {
  const std::uint32_t n = interleave_;
  std::uint32_t bits = 0;
  for (std::uint32_t tile_y = 0; tile_y < kTileSide; ++tile_y) {
    const std::uint32_t y = (at.by * kTileSide + tile_y) * n + at.sy;
    if (y >= geometry_.height) break;
    for (std::uint32_t tile_x = 0; tile_x < kTileSide; ++tile_x) {
      const std::uint32_t x = (at.bx * kTileSide + tile_x) * n + at.sx;
      if (x >= geometry_.width) break;
      const float depth = geometry_.depth[y * geometry_.width + x];
      if (depth == kNoSurface) continue;
      bits |= 1u << (clusters_ ? cluster_slice_of(slices_, depth) : tile_y / 4 * 4 + tile_x / 4);
    }
  }
  occupied_[tile(at)] = bits;
}

void TileParts::fill_cells(const TileAddress& at) {
  PixelList pixels;
  list_pixels(geometry_, at, pixels);
  std::uint32_t part = first_[tile(at)];
  float nearest = kNoSurface;
  for (std::uint32_t i = 0, lane = 0; i < pixels.count; ++i) {
    CellPixels& cell = cells_[part];
    const TilePixel& pixel = pixels.entries[i];
    cell.x[lane] = pixel.view.x / pixel.view.z, cell.y[lane] = pixel.view.y / pixel.view.z;
    cell.depth[lane++] = pixel.view.z;
    nearest = std::min(nearest, pixel.view.z);
    if (i + 1 < pixels.count && pixels.entries[i + 1].cell == pixel.cell) continue;
    for (; lane < kGroupPixels; ++lane) cell.x[lane] = cell.y[lane] = 0, cell.depth[lane] = kNoPixel;
    nearest_[part++] = nearest;
    nearest = kNoSurface, lane = 0;
  }
}

// Sorted by part, by counting; pixels of a part stay in the order of their cells.
void TileParts::read(const TileAddress& address, ScreenTile& tile_pixels) const {
  PixelList pixels, sorted;
  list_pixels(geometry_, address, pixels);
  std::uint32_t begin[kPartsOfTile + 1] = {};
  for (std::uint32_t i = 0; i < pixels.count; ++i) ++begin[part_in_tile(pixels.entries[i]) + 1];
  std::partial_sum(begin, begin + kPartsOfTile + 1, begin);
  std::uint32_t next[kPartsOfTile];
  std::copy(begin, begin + kPartsOfTile, next);
  for (std::uint32_t i = 0; i < pixels.count; ++i) {
    sorted.entries[next[part_in_tile(pixels.entries[i])]++] = pixels.entries[i];
  }
  tile_pixels.group_count = 0;
  std::uint32_t part = first_[tile(address)];
  for (std::uint32_t p = 0; p < kPartsOfTile; ++p) {
    const std::uint32_t count = begin[p + 1] - begin[p];
    if (count > 0) append_groups(geometry_, sorted.entries + begin[p], count, part++, tile_pixels);
  }
}

}  // namespace luciole
