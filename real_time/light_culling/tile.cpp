// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_culling/tile.h"

#include <algorithm>

namespace luciole {
namespace {

// Slopes are widened by a few units in the last place: they bound rounded quotients.
void grow(TileHalf& half, Vec3 view) {
  const float x = view.x / view.z, y = view.y / view.z;
  const float margin_x = 1e-6f * (1.0f + std::abs(x)), margin_y = 1e-6f * (1.0f + std::abs(y));
  if (half.pixels++ == 0) {
    half.x0 = x - margin_x, half.x1 = x + margin_x, half.y0 = y - margin_y, half.y1 = y + margin_y;
    half.z0 = view.z * (1 - 1e-6f), half.z1 = view.z * (1 + 1e-6f);
    return;
  }
  half.x0 = std::min(half.x0, x - margin_x), half.x1 = std::max(half.x1, x + margin_x);
  half.y0 = std::min(half.y0, y - margin_y), half.y1 = std::max(half.y1, y + margin_y);
  half.z0 = std::min(half.z0, view.z * (1 - 1e-6f)), half.z1 = std::max(half.z1, view.z * (1 + 1e-6f));
}

void copy_plane3(float (&to)[3][kGroupPixels], const Plane3& from, const std::uint32_t* pixel) {
  for (int axis = 0; axis < 3; ++axis)
    for (int lane = 0; lane < kGroupPixels; ++lane) to[axis][lane] = from[axis][pixel[lane]];
}

void fill_group(const GeometryBuffer& geometry, const TilePixel* pixels, std::uint32_t count, std::uint32_t part,
                PixelGroup& group) {
  group.count = count;
  group.part = part;
  Vec3 low = pixels[0].view, high = low;
  for (std::uint32_t lane = 0; lane < kGroupPixels; ++lane) {
    const TilePixel& source = pixels[lane < count ? lane : 0];
    group.pixel[lane] = source.pixel;
    low = min(low, source.view), high = max(high, source.view);
  }
  const float box_low[3] = {low.x, low.y, low.z}, box_high[3] = {high.x, high.y, high.z};
  std::copy(box_low, box_low + 3, group.view_low);
  std::copy(box_high, box_high + 3, group.view_high);
  copy_plane3(group.position, geometry.position, group.pixel);
  copy_plane3(group.normal, geometry.normal, group.pixel);
  copy_plane3(group.geometric_normal, geometry.geometric_normal, group.pixel);
  copy_plane3(group.f0, geometry.f0, group.pixel);
  const Vec3 eye = geometry.camera.eye;
  for (int lane = 0; lane < kGroupPixels; ++lane) {
    group.f90[lane] = geometry.f90[group.pixel[lane]];
    group.ggx_alpha[lane] = geometry.ggx_alpha[group.pixel[lane]];
    const Vec3 to_eye =
        normalize(eye - Vec3(group.position[0][lane], group.position[1][lane], group.position[2][lane]));
    group.to_eye[0][lane] = to_eye.x, group.to_eye[1][lane] = to_eye.y, group.to_eye[2][lane] = to_eye.z;
  }
}

}  // namespace

// The tile's pixels in the order of 4x4 groups, so that sixteen neighbours in the list are neighbours on the screen.
void list_pixels(const GeometryBuffer& geometry, const TileAddress& at, PixelList& list) {
  const std::uint32_t n = at.interleave;
  const Vec3 eye = geometry.camera.eye, right = geometry.camera.right, up = geometry.camera.up;
  list.count = 0;
  for (std::uint32_t i = 0; i < kTilePixels; ++i) {
    const std::uint32_t tile_x = (i / 16 % 4) * 4 + i % 4, tile_y = (i / 64) * 4 + i / 4 % 4;
    const std::uint32_t x = (at.bx * kTileSide + tile_x) * n + at.sx, y = (at.by * kTileSide + tile_y) * n + at.sy;
    if (x >= geometry.width || y >= geometry.height) continue;
    const std::uint32_t pixel = y * geometry.width + x;
    const float depth = geometry.depth[pixel];
    if (depth == kNoSurface) continue;
    const Vec3 p = Vec3(geometry.position[0][pixel], geometry.position[1][pixel], geometry.position[2][pixel]) - eye;
    list.entries[list.count++] = {pixel, i / 16, Vec3(dot(p, right), dot(p, up), depth)};
  }
}

void append_groups(const GeometryBuffer& geometry, const TilePixel* pixels, std::uint32_t count, std::uint32_t part,
                   ScreenTile& tile) {
  for (std::uint32_t first = 0; first < count; first += kGroupPixels) {
    if (tile.groups.size() <= tile.group_count) tile.groups.emplace_back();
    fill_group(geometry, pixels + first, std::min<std::uint32_t>(kGroupPixels, count - first), part,
               tile.groups[tile.group_count++]);
  }
}

void read_tile(const GeometryBuffer& geometry, const TileAddress& address, ScreenTile& tile) {
  PixelList all, halves[2];
  list_pixels(geometry, address, all);
  tile.half[0] = tile.half[1] = TileHalf{};
  tile.group_count = 0;
  float nearest = kNoSurface, farthest = 0;
  for (std::uint32_t i = 0; i < all.count; ++i) {
    nearest = std::min(nearest, all.entries[i].view.z);
    farthest = std::max(farthest, all.entries[i].view.z);
  }
  const float middle = 0.5f * (nearest + farthest);
  for (std::uint32_t i = 0; i < all.count; ++i) {
    const int half = all.entries[i].view.z > middle;
    halves[half].entries[halves[half].count++] = all.entries[i];
    grow(tile.half[half], all.entries[i].view);
  }
  for (std::uint32_t half = 0; half < 2; ++half)
    append_groups(geometry, halves[half].entries, halves[half].count, half, tile);
}

}  // namespace luciole
