// SPDX-License-Identifier: Apache-2.0
#include "real_time/geometry_buffer/geometry_buffer_pass.h"

#include <emmintrin.h>

#include <algorithm>

#include "base/fold_seed.h"
#include "base/parallel.h"
#include "equations/cpp/float.h"
#include "real_time/geometry_buffer/pixel_block.h"

namespace luciole {
namespace {

constexpr std::uint32_t kDimensionSubPixel = 6;

// Copies 16 bytes past the caches: a frame's planes are larger than these, and a store that goes through them first
// reads the line that it overwrites.
//   to, from  on a boundary of 16 bytes
void stream(void* to, const void* from) {
  _mm_stream_si128(static_cast<__m128i*>(to), _mm_load_si128(static_cast<const __m128i*>(from)));
}

// Copies one value of every pixel of a block to its plane, a row at a time.
template <class T>
void write_plane(const PixelBlock& block, const GeometryBuffer& screen, const T* values, AlignedVector<T>& plane) {
  static_assert(sizeof(T) == 4);
  const bool aligned = screen.width % 4 == 0;
  for (std::uint32_t y = 0; y < block.height; ++y) {
    T* row = plane.data() + std::size_t(block.top + y) * screen.width + block.left;
    const T* from = values + (y / 4 * kPacketsAcross) * kPacketRays + y % 4 * 4;
    for (std::uint32_t x = 0; x < block.width; x += 4, from += kPacketRays) {
      if (aligned && x + 4 <= block.width) {
        stream(row + x, from);
      } else {
        std::copy_n(from, std::min(4u, block.width - x), row + x);
      }
    }
  }
}

void write_planes(const PixelBlock& block, Quantity first, GeometryBuffer& out, Plane3& planes) {
  for (std::size_t axis = 0; axis < 3; ++axis) write_plane(block, out, block.value[first + axis], planes[axis]);
}

void write_block(const PixelBlock& block, GeometryBuffer& out) {
  write_plane(block, out, block.value[kDepth], out.depth);
  write_planes(block, kPosition, out, out.position);
  write_planes(block, kNormal, out, out.normal);
  write_planes(block, kGeometricNormal, out, out.geometric_normal);
  write_planes(block, kDiffuseAlbedo, out, out.diffuse_albedo);
  write_planes(block, kF0, out, out.f0);
  write_plane(block, out, block.value[kF90], out.f90);
  write_plane(block, out, block.value[kGgxAlpha], out.ggx_alpha);
  write_planes(block, kEmission, out, out.emission);
  write_plane(block, out, block.material, out.material);
}

}  // namespace

void render_geometry_buffer(const GeometryBufferInputs& inputs, GeometryBuffer& buffer) {
  buffer.resize(inputs.width, inputs.height);
  buffer.camera = inputs.camera;
  buffer.sub_pixel_x = inputs.sub_pixel.x, buffer.sub_pixel_y = inputs.sub_pixel.y;
  const BlockRenderer renderer(inputs);
  const std::uint32_t columns = (inputs.width + kBlock - 1) / kBlock, rows = (inputs.height + kBlock - 1) / kBlock;
  parallel_for(std::size_t(columns) * rows, 1, [&](std::size_t begin, std::size_t end) {
    PixelBlock block;
    for (std::size_t i = begin; i < end; ++i) {
      block.left = static_cast<std::uint32_t>(i % columns) * kBlock;
      block.top = static_cast<std::uint32_t>(i / columns) * kBlock;
      block.width = std::min(kBlock, inputs.width - block.left);
      block.height = std::min(kBlock, inputs.height - block.top);
      renderer.render(block);
      write_block(block, buffer);
    }
    _mm_sfence();  // streamed values are in place before anybody is told that the work is done
  });
}

Vec2 jittered_sub_pixel(std::uint64_t seed, std::uint64_t frame) {
  // The plane's additive recurrence with the least discrepancy: steps 1/g and 1/g^2, g^3 = g + 1 [Roberts 2018].
  // In 32-bit fixed point, so that no frame is too late for it.
  constexpr std::uint32_t kStepX = 3242174889u, kStepY = 2447445414u;
  const f32::RandomWords start = f32::random_words(folded(seed), 0, 0, kDimensionSubPixel);
  const auto step = static_cast<std::uint32_t>(frame);
  const auto unit = [](std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; };
  return {unit(start.first + step * kStepX), unit(start.second + step * kStepY)};
}

}  // namespace luciole
