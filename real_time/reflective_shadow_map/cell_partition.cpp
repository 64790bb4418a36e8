// SPDX-License-Identifier: Apache-2.0
#include "real_time/reflective_shadow_map/cell_partition.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace luciole {
namespace {

constexpr float kCurveSide = 65536.0f;

// A coordinate of the unit interval on the curve's grid.
std::uint32_t grid_coordinate(float t, float scale) {
  return static_cast<std::uint32_t>(std::clamp(t * scale * kCurveSide, 0.0f, kCurveSide - 1.0f));
}

std::uint32_t row_count(std::uint32_t cells, float aspect) {
  const double rows = std::round(std::sqrt(static_cast<double>(cells) / static_cast<double>(aspect)));
  return static_cast<std::uint32_t>(std::clamp(rows, 1.0, std::max(1.0, static_cast<double>(cells))));
}

}  // namespace

std::uint32_t hilbert_index(std::uint32_t x, std::uint32_t y) {
  std::uint32_t index = 0;
  for (std::uint32_t side = 32768; side > 0; side /= 2) {
    const std::uint32_t right = (x & side) != 0, top = (y & side) != 0;
    index = index * 4 + ((3 * right) ^ top);
    if (top != 0) continue;
    // The lower quadrants hold the curve mirrored in a diagonal.
    if (right != 0) x = 65535 - x, y = 65535 - y;
    std::swap(x, y);
  }
  return index;
}

CellPartition::CellPartition(std::uint32_t cells, float aspect) : rows_(row_count(cells, aspect)), order_(cells) {
  const float scale_u = std::min(1.0f, aspect), scale_v = std::min(1.0f, 1.0f / aspect);
  struct Numbered {
    std::uint32_t place;
    Cell cell;
  };
  std::vector<Numbered> numbered;
  numbered.reserve(cells);
  for (std::uint32_t row = 0; row < rows_; ++row) {
    const std::uint32_t first = row_start(row), count = row_start(row + 1) - first;
    const float v = (static_cast<float>(first) + 0.5f * static_cast<float>(count)) / static_cast<float>(cells);
    for (std::uint32_t column = 0; column < count; ++column) {
      const float u = (static_cast<float>(column) + 0.5f) / static_cast<float>(count);
      numbered.push_back({hilbert_index(grid_coordinate(u, scale_u), grid_coordinate(v, scale_v)), {row, column}});
    }
  }
  std::stable_sort(numbered.begin(), numbered.end(),
                   [](const Numbered& a, const Numbered& b) { return a.place < b.place; });
  std::transform(numbered.begin(), numbered.end(), order_.begin(), [](const Numbered& n) { return n.cell; });
}

Vec2 CellPartition::point(std::uint32_t index, Vec2 within) const {
  const Cell at = order_[index];
  const std::uint32_t first = row_start(at.row);
  const auto count = static_cast<float>(row_start(at.row + 1) - first);
  return {(static_cast<float>(at.column) + within.x) / count,
          (static_cast<float>(first) + within.y * count) / static_cast<float>(order_.size())};
}

}  // namespace luciole
