// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_culling/cull_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
#include "equations/cpp/wide_lists.inc"
namespace {

#include "real_time/light_culling/side_planes.inc"

LUCIOLE_FN TileTestEllipsoid load_ellipsoid(const BoundBlock& b, int lane) {
  const auto row = [&](BoundBlock::Row r) { return load(b.row[r] + lane); };
  TileTestEllipsoid t;
  t.factor.m00 = row(BoundBlock::kM00), t.factor.m01 = row(BoundBlock::kM01), t.factor.m02 = row(BoundBlock::kM02);
  t.factor.m11 = row(BoundBlock::kM11), t.factor.m12 = row(BoundBlock::kM12), t.factor.m22 = row(BoundBlock::kM22);
  t.stretched = real3(row(BoundBlock::kStretchedX), row(BoundBlock::kStretchedY), row(BoundBlock::kStretchedZ));
  t.centre = real3(row(BoundBlock::kCentreX), row(BoundBlock::kCentreY), row(BoundBlock::kCentreZ));
  t.sxx = row(BoundBlock::kSxx), t.sxz = row(BoundBlock::kSxz), t.syy = row(BoundBlock::kSyy);
  t.syz = row(BoundBlock::kSyz), t.szz = row(BoundBlock::kSzz);
  t.surface.normal = real3(row(BoundBlock::kNormalX), row(BoundBlock::kNormalY), row(BoundBlock::kNormalZ));
  t.surface.offset = row(BoundBlock::kNormalOffset);
  return t;
}

LUCIOLE_FN void append_light(TouchingLights& list, const TileTestEllipsoid& t, std::uint32_t first, mask chosen) {
  const auto put = [&](TouchingLights::Row row, real value) { append(list.row[row] + list.count, value, chosen); };
  put(TouchingLights::kM00, t.factor.m00), put(TouchingLights::kM01, t.factor.m01);
  put(TouchingLights::kM02, t.factor.m02), put(TouchingLights::kM11, t.factor.m11);
  put(TouchingLights::kM12, t.factor.m12), put(TouchingLights::kM22, t.factor.m22);
  put(TouchingLights::kX, t.stretched.x), put(TouchingLights::kY, t.stretched.y),
      put(TouchingLights::kZ, t.stretched.z);
  put(TouchingLights::kNx, t.surface.normal.x), put(TouchingLights::kNy, t.surface.normal.y);
  put(TouchingLights::kNz, t.surface.normal.z), put(TouchingLights::kOffset, t.surface.offset);
  list.count += static_cast<std::uint32_t>(append_indices(list.index + list.count, first, chosen));
}

LUCIOLE_FN PaperTestEllipsoid load_paper_ellipsoid(const BoundBlock& b, int lane) {
  const auto rows = [&](int r) {
    return real3(load(b.row[r] + lane), load(b.row[r + 1] + lane), load(b.row[r + 2] + lane));
  };
  PaperTestEllipsoid t;
  t.row_x = rows(BoundBlock::kPaper), t.row_y = rows(BoundBlock::kPaper + 3), t.row_z = rows(BoundBlock::kPaper + 6);
  t.stretched = rows(BoundBlock::kPaper + 9);
  return t;
}

template <TileTest test>
void cull(const BoundBlock* blocks, std::uint32_t block_count, const TileFrustum& frustum, TouchingLights& near_half,
          TouchingLights& far_half) {
  const SidePlanes sides = side_planes(frustum);
  const Tile tile = tile_of(frustum);
  const bool has_near = frustum.near_low <= frustum.near_high, has_far = frustum.far_low <= frustum.far_high;
  for (std::uint32_t b = 0; b < block_count; ++b) {
    for (int lane = 0; lane < 16; lane += kLanes) {
      const BoundBlock& block = blocks[b];
      const real3 centre =
          real3(load(block.row[BoundBlock::kCentreX] + lane), load(block.row[BoundBlock::kCentreY] + lane),
                load(block.row[BoundBlock::kCentreZ] + lane));
      const real radius = load(block.row[BoundBlock::kRadius] + lane);
      // The paper's test stands alone, so that its lists are the paper's.
      const mask candidates =
          test == TileTest::paper ? radius >= 0.0f : sphere_may_touch(sides, centre, radius) && radius >= 0.0f;
      if (!any(candidates)) continue;
      const TileTestEllipsoid t = load_ellipsoid(block, lane);
      HalfMasks touches;
      if constexpr (test == TileTest::paper) {
        touches = touches_tile_as_paper(load_paper_ellipsoid(block, lane), tile);
      } else if constexpr (test == TileTest::exact) {
        touches = ellipsoid_touches_tile_exactly(t, tile);
      } else {
        touches = ellipsoid_touches_tile(t, tile);
      }
      const std::uint32_t first = b * 16 + static_cast<std::uint32_t>(lane);
      const mask near_hits = candidates && touches.near_half, far_hits = candidates && touches.far_half;
      if (has_near && any(near_hits)) append_light(near_half, t, first, near_hits);
      if (has_far && any(far_hits)) append_light(far_half, t, first, far_hits);
    }
  }
}

}  // namespace

void cull_tile(const BoundBlock* blocks, std::uint32_t block_count, const TileFrustum& frustum, TileTest test,
               TouchingLights& near_half, TouchingLights& far_half) {
  near_half.count = far_half.count = 0;
  switch (test) {
    case TileTest::paper:
      return cull<TileTest::paper>(blocks, block_count, frustum, near_half, far_half);
    case TileTest::exact:
      return cull<TileTest::exact>(blocks, block_count, frustum, near_half, far_half);
    default:
      return cull<TileTest::tight>(blocks, block_count, frustum, near_half, far_half);
  }
}

std::uint32_t cull_group(const TouchingLights& lights, const PixelGroup& group, std::uint32_t* list) {
  const float half_x = 0.5f * (group.view_high[0] - group.view_low[0]);
  const float half_y = 0.5f * (group.view_high[1] - group.view_low[1]);
  const float half_z = 0.5f * (group.view_high[2] - group.view_low[2]);
  const real x = group.view_low[0] + half_x, y = group.view_low[1] + half_y, z = group.view_low[2] + half_z;
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < lights.count; i += kLanes) {
    const auto row = [&](TouchingLights::Row r) { return load_unaligned(lights.row[r] + i); };
    const real m00 = row(TouchingLights::kM00), m01 = row(TouchingLights::kM01), m02 = row(TouchingLights::kM02);
    const real m11 = row(TouchingLights::kM11), m12 = row(TouchingLights::kM12), m22 = row(TouchingLights::kM22);
    // The box round the stretched box, and its distance to the unit sphere's centre.
    const real ex = max(abs(m00 * x + m01 * y + m02 * z - row(TouchingLights::kX)) - m00 * half_x - abs(m01) * half_y -
                            abs(m02) * half_z,
                        real(0.0f));
    const real ey =
        max(abs(m11 * y + m12 * z - row(TouchingLights::kY)) - m11 * half_y - abs(m12) * half_z, real(0.0f));
    const real ez = max(abs(m22 * z - row(TouchingLights::kZ)) - m22 * half_z, real(0.0f));
    const real nx = row(TouchingLights::kNx), ny = row(TouchingLights::kNy), nz = row(TouchingLights::kNz);
    const real highest = nx * x + ny * y + nz * z + abs(nx) * half_x + abs(ny) * half_y + abs(nz) * half_z;
    const mask touches = ex * ex + ey * ey + ez * ez <= 1.0002f && highest > row(TouchingLights::kOffset) &&
                         first_lanes(lights.count - i);
    for (std::uint32_t bits = lane_bits(touches); bits != 0; bits &= bits - 1)
      list[count++] = lights.index[i + static_cast<std::uint32_t>(__builtin_ctz(bits))];
  }
  return count;
}

}  // namespace luciole::LUCIOLE_ISA
