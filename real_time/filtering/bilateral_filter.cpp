// SPDX-License-Identifier: Apache-2.0
#include "real_time/filtering/bilateral_filter.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/parallel.h"
#include "real_time/filtering/filter_tile.h"

namespace luciole {
namespace {

struct FilterKernels {
  void (*gather)(const FilterPicture&, FilterTile&);
  void (*filter)(const FilterPicture&, const FilterTile&);
};

FilterKernels kernels_of(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return {avx512::gather_tile, avx512::filter_tile};
    case Isa::avx2:
      return {avx2::gather_tile, avx2::filter_tile};
    default:
      return {baseline::gather_tile, baseline::filter_tile};
  }
}

void copy_axis(float (&to)[3], Vec3 axis) { to[0] = axis.x, to[1] = axis.y, to[2] = axis.z; }

FilterPicture picture_of(const BilateralFilterPass::Inputs& inputs, Radiance& clean) {
  const GeometryBuffer& g = inputs.geometry;
  FilterPicture picture;
  picture.width = static_cast<int>(g.width), picture.height = static_cast<int>(g.height);
  picture.radius = inputs.radius;
  picture.depth = g.depth.data();
  picture.ggx_alpha = g.ggx_alpha.data();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    picture.normal[axis] = g.normal[axis].data();
    picture.geometric_normal[axis] = g.geometric_normal[axis].data();
    picture.f0[axis] = g.f0[axis].data();
    picture.noisy[axis] = inputs.noisy.diffuse[axis].data();
    picture.noisy[axis + 3] = inputs.noisy.specular[axis].data();
    picture.clean[axis] = clean.diffuse[axis].data();
    picture.clean[axis + 3] = clean.specular[axis].data();
  }
  copy_axis(picture.right, g.camera.right);
  copy_axis(picture.up, g.camera.up);
  copy_axis(picture.forward, g.camera.forward);
  const FilterView view = filter_view(g);
  picture.footprint = view.footprint, picture.left_edge = view.left_edge, picture.top_edge = view.top_edge;
  return picture;
}

void resize_planes(Radiance& radiance, std::size_t pixels) {
  for (Plane& plane : radiance.diffuse) plane.resize(pixels);
  for (Plane& plane : radiance.specular) plane.resize(pixels);
}

}  // namespace

FilterRadius filter_radius(std::uint32_t interleave) {
  LUCIOLE_ASSERT_LE(interleave, std::uint32_t(kLargestFilterRadius));
  const int multiple = static_cast<int>(std::max(interleave, 1u));
  const int radius = kLargestFilterRadius / multiple * multiple;
  return {radius, radius};
}

FilterView filter_view(const GeometryBuffer& g) {
  return {2.0f * std::tan(0.5f * g.camera.vertical_fov) / static_cast<float>(g.height),
          g.sub_pixel_x - 0.5f * static_cast<float>(g.width), g.sub_pixel_y - 0.5f * static_cast<float>(g.height)};
}

const Radiance& BilateralFilterPass::run(const Inputs& inputs) {
  LUCIOLE_ASSERT_LE(inputs.radius.x, kLargestFilterRadius);
  LUCIOLE_ASSERT_LE(inputs.radius.y, kLargestFilterRadius);
  const std::size_t pixels = inputs.noisy.diffuse[0].empty() ? 0 : inputs.geometry.pixel_count();
  resize_planes(clean_, pixels);
  if (pixels == 0) return clean_;
  const FilterKernels kernels = kernels_of(inputs.isa);
  const FilterPicture picture = picture_of(inputs, clean_);
  const auto across = static_cast<std::size_t>((picture.width + kFilterTile - 1) / kFilterTile);
  const auto down = static_cast<std::size_t>((picture.height + kFilterTile - 1) / kFilterTile);
  parallel_for(across * down, 1, [&](std::size_t begin, std::size_t end) {
    AlignedVector<float> scratch(kFilterScratch);
    for (std::size_t index = begin; index < end; ++index) {
      FilterTile tile;
      tile.x = static_cast<int>(index % across) * kFilterTile;
      tile.y = static_cast<int>(index / across) * kFilterTile;
      tile.width = std::min(kFilterTile, picture.width - tile.x);
      tile.height = std::min(kFilterTile, picture.height - tile.y);
      tile.scratch = scratch.data();
      kernels.gather(picture, tile);
      kernels.filter(picture, tile);
    }
  });
  return clean_;
}

}  // namespace luciole
