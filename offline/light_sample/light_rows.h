// SPDX-License-Identifier: Apache-2.0
// Lights laid out for weigh_kernel.h, in memory that is kept from group to group.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "offline/light_sample/weigh_kernel.h"

namespace luciole {

inline constexpr std::size_t kBlockLights = 16;  // rows are whole numbers of these long

using LightRowValues = std::array<float, LightRowsView::kRows>;

// In the order of LightRowsView::Row.
inline LightRowValues row_values(const LightRecord& light, float xi) {
  return {light.x,
          light.y,
          light.z,
          light.radius,
          light.axis_x,
          light.axis_y,
          light.axis_z,
          light.intensity,
          light.scale,
          light.offset,
          light.two_sided,
          light.lamp,
          xi};
}

class LightRows {
 public:
  void clear() { lights_.clear(), tints_.clear(); }
  // Forgets all but the first `count` lights.
  void shorten(std::uint32_t count) { lights_.resize(count), tints_.resize(count); }
  //   tint  as LightSet::tint
  //   xi    of the light in this pass; 0 where no range counts
  void add(std::uint32_t light, const LightRecord& record, Vec3 tint, float xi) {
    const std::size_t at = lights_.size();
    if (at >= rows_[0].size()) grow();
    lights_.push_back(light), tints_.push_back(tint);
    const LightRowValues values = row_values(record, xi);
    for (std::size_t r = 0; r < LightRowsView::kRows; ++r) rows_[r][at] = values[r];
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(lights_.size()); }
  const std::uint32_t* lights() const { return lights_.data(); }
  const Vec3* tints() const { return tints_.data(); }
  // `count` lights from `first` on; first is a multiple of 16.
  LightRowsView view(std::uint32_t first, std::uint32_t count) const {
    LightRowsView view;
    for (std::size_t r = 0; r < LightRowsView::kRows; ++r) view.row[r] = rows_[r].data() + first;
    view.count = count;
    return view;
  }
  std::uint64_t memory_bytes() const {
    return rows_[0].size() * sizeof(float) * LightRowsView::kRows +
           lights_.capacity() * (sizeof(std::uint32_t) + sizeof(Vec3));
  }

 private:
  void grow() {
    for (AlignedVector<float>& row : rows_) {
      const std::size_t before = row.size();
      row.resize(before == 0 ? 256 : before * 2);
      std::fill(row.begin() + static_cast<std::ptrdiff_t>(before), row.end(), 0.0f);  // what pads the last 16
    }
  }

  std::array<AlignedVector<float>, LightRowsView::kRows> rows_;
  std::vector<std::uint32_t> lights_;
  std::vector<Vec3> tints_;
};

}  // namespace luciole
