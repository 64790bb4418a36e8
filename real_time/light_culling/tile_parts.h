// SPDX-License-Identifier: Apache-2.0
// The parts of the tiles that have a list of lights of their own in the rivals of tiled culling: clusters, which are 32
// depth slices of each tile of each sub-region (Örtegren and Persson, Clustered Shading, GPU Pro 7, 2016), or cells of
// 4x4 pixels, which are what splatting fills. Only parts that show a surface are numbered.
#pragma once
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "real_time/light_culling/proxy_kernel.h"
#include "real_time/light_culling/tile.h"
#include "real_time/settings.h"

namespace luciole {

class TileParts {
 public:
  // Of every sub-region.  culling: clustered or splatting
  TileParts(const GeometryBuffer& geometry, std::uint32_t interleave, Culling culling);

  // Tiles of one sub-region; all have as many, and sub-region s is row s / n, column s % n.
  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  std::uint32_t tiles() const { return columns_ * rows_; }
  std::uint32_t tile(const TileAddress& at) const;  // its number among the tiles of all sub-regions
  const ClusterSlices& slices() const { return slices_; }

  // Per tile: a bit per part that shows a surface, and the number of the first of these.
  const std::vector<std::uint32_t>& occupied() const { return occupied_; }
  const std::vector<std::uint32_t>& first() const { return first_; }
  std::uint32_t count() const { return count_; }

  SplatCells cells() const { return {cells_.data(), nearest_.data()}; }  // none of clusters

  // Reads a tile's pixels, group by group, none of two parts.
  void read(const TileAddress& address, ScreenTile& tile) const;

  double busy_seconds() const { return busy_seconds_; }  // that the constructor took, summed over threads

 private:
  void find_occupied(const TileAddress& at);
  void fill_cells(const TileAddress& at);
  std::uint32_t part_in_tile(const TilePixel& pixel) const;
  template <class Visit>
  void for_each_tile(const Visit& visit);

  const GeometryBuffer& geometry_;
  std::uint32_t interleave_, columns_, rows_, count_ = 0;
  bool clusters_;
  ClusterSlices slices_{};
  std::vector<std::uint32_t> occupied_, first_;
  AlignedVector<CellPixels> cells_;
  AlignedVector<float> nearest_;
  double busy_seconds_ = 0;
};

}  // namespace luciole
