// SPDX-License-Identifier: Apache-2.0
// The texels of a light's map: the unit square cut into exactly n cells of equal area, for any n, and the order in
// which they are numbered.
#pragma once
#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace luciole {

// A rectangle is cut into rows of nearly equal numbers of cells. Row r of R holds k = floor((r+1) n/R) - floor(r n/R)
// cells and is k/n high, each of its cells 1/k wide: so that every cell has area 1/n to the last bit of the formula,
// and samples, one per cell, are stratified in both directions. With n = 256 x 256 and a square this is the plain grid.
//
// Cells are numbered along a Hilbert curve. Like Morton's, an aligned run of 4^k cells is a block of the map, so that
// every 64th cell is a well-spread 1/64 of the map; but successive cells are neighbours everywhere, so any run of 64 is
// compact, also after cells that met nothing have been dropped.
class CellPartition {
 public:
  struct Cell {
    std::uint32_t row, column;
  };

  // cells   n >= 0
  // aspect  width over height of the rectangle that the unit square stands for; cells come out nearly square there
  CellPartition(std::uint32_t cells, float aspect);

  std::uint32_t size() const { return static_cast<std::uint32_t>(order_.size()); }
  std::uint32_t rows() const { return rows_; }
  Cell cell(std::uint32_t index) const { return order_[index]; }

  // A point of a cell.
  //   index   along the curve
  //   within  where in the cell, [0,1]^2; (.5, .5) is its centre
  //   returns a point of the unit square
  Vec2 point(std::uint32_t index, Vec2 within) const;

 private:
  std::uint32_t row_start(std::uint32_t row) const {
    return static_cast<std::uint32_t>(std::uint64_t{row} * order_.size() / rows_);
  }

  std::uint32_t rows_ = 0;
  std::vector<Cell> order_;
};

// Place of a cell along the Hilbert curve through a 65536 x 65536 grid; x, y < 65536.     [Hilbert 1891]
std::uint32_t hilbert_index(std::uint32_t x, std::uint32_t y);

}  // namespace luciole
