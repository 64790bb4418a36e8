// SPDX-License-Identifier: Apache-2.0
#include "real_time/geometry_buffer/geometry_buffer_pass.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "equations/cpp/float.h"
#include "real_time/fold_seed.h"
#include "scene/sky.h"
#include "scene/surface.h"

namespace luciole {
namespace {

constexpr std::uint32_t kBlock = 16;  // pixels per side of the unit of work: 16 packets, a few textures in the cache
constexpr std::uint32_t kNoMaterial = 0xffffffffu;
constexpr std::uint32_t kDimensionSubPixel = 6;

// The plane of pixels at distance 1 in front of the eye. Directions are not unit: their part along `forward` is 1, so
// that distances along them are depths.
struct ScreenRays {
  Vec3 top_left, across, down;
  float pixel_size;  // height of a pixel at distance 1 [m]

  explicit ScreenRays(const GeometryBufferInputs& inputs) {
    const Camera& camera = inputs.camera;
    const float half_height = std::tan(0.5f * camera.vertical_fov);
    pixel_size = 2 * half_height / static_cast<float>(inputs.height);
    across = camera.right * pixel_size, down = camera.up * -pixel_size;
    top_left = camera.forward - across * (0.5f * static_cast<float>(inputs.width)) -
               down * (0.5f * static_cast<float>(inputs.height)) + across * inputs.sub_pixel.x +
               down * inputs.sub_pixel.y;
  }
  Vec3 direction(std::uint32_t x, std::uint32_t y) const {
    return top_left + across * static_cast<float>(x) + down * static_cast<float>(y);
  }
};

// The pixels of one block, before they go to the planes. Written straight from here pixel by pixel, 25 planes would be
// 25 streams of scattered stores, each of which misses caches and address translation.
struct BlockPixel {
  SurfacePoint point;
  float depth;
  std::uint32_t material;
};
struct Block {
  std::uint32_t left, top, width, height;  // of the part inside the screen
  BlockPixel pixels[kBlock * kBlock];      // row-major, kBlock per row
};

BlockPixel sky_pixel(Vec3 radiance) {
  BlockPixel pixel{{}, kNoSurface, kNoMaterial};
  pixel.point.ggx_alpha = 1;
  pixel.point.emission = radiance;
  return pixel;
}

// Traces the 4x4 pixels from (x0, y0) of the block on.
void render_packet(const GeometryBufferInputs& inputs, const ScreenRays& screen, std::uint32_t x0, std::uint32_t y0,
                   Block& block) {
  RayPacket rays;
  Vec3 directions[kPacketRays];
  for (std::uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const std::uint32_t x = x0 + lane % 4, y = y0 + lane / 4;
    directions[lane] = screen.direction(block.left + x, block.top + y);
    rays.set(static_cast<int>(lane), inputs.camera.eye, directions[lane], 0, kNoSurface);
    if (x >= block.width || y >= block.height) rays.active[lane] = 0;
  }
  const HitPacket hits = inputs.scene.intersect(rays, Coherence::coherent);
  const Scene& scene = inputs.scene.scene();
  for (std::uint32_t lane = 0; lane < kPacketRays; ++lane) {
    if (rays.active[lane] == 0) continue;
    BlockPixel& pixel = block.pixels[(y0 + lane / 4) * kBlock + (x0 + lane % 4)];
    const Vec3 direction = normalize(directions[lane]);
    if (hits.mesh[lane] == kNoHit) {
      pixel = sky_pixel(sky_radiance(scene.environment, direction));
      continue;
    }
    const SurfaceHit hit{hits.mesh[lane], hits.triangle[lane], hits.u[lane], hits.v[lane]};
    const float cone_width = screen.pixel_size * hits.distance[lane];
    pixel.point = evaluate_surface(scene, hit, direction, cone_width);
    pixel.depth = dot(pixel.point.position - inputs.camera.eye, inputs.camera.forward);
    pixel.material = scene.meshes[hit.mesh].material;
  }
}

// Copies one value of every pixel of a block to its plane, a row at a time.
template <class T, class Value>
void write_plane(const Block& block, const GeometryBuffer& screen, AlignedVector<T>& plane, const Value& value) {
  for (std::uint32_t y = 0; y < block.height; ++y) {
    T* row = plane.data() + std::size_t(block.top + y) * screen.width + block.left;
    for (std::uint32_t x = 0; x < block.width; ++x) row[x] = value(block.pixels[y * kBlock + x]);
  }
}

void write_planes(const Block& block, const GeometryBuffer& screen, Plane3& planes, Vec3 SurfacePoint::*member) {
  write_plane(block, screen, planes[0], [member](const BlockPixel& p) { return (p.point.*member).x; });
  write_plane(block, screen, planes[1], [member](const BlockPixel& p) { return (p.point.*member).y; });
  write_plane(block, screen, planes[2], [member](const BlockPixel& p) { return (p.point.*member).z; });
}

void write_block(const Block& block, GeometryBuffer& out) {
  write_plane(block, out, out.depth, [](const BlockPixel& p) { return p.depth; });
  write_planes(block, out, out.position, &SurfacePoint::position);
  write_planes(block, out, out.normal, &SurfacePoint::shading_normal);
  write_planes(block, out, out.geometric_normal, &SurfacePoint::geometric_normal);
  write_planes(block, out, out.diffuse_albedo, &SurfacePoint::diffuse_albedo);
  write_planes(block, out, out.f0, &SurfacePoint::f0);
  write_plane(block, out, out.f90, [](const BlockPixel& p) { return p.point.f90; });
  write_plane(block, out, out.ggx_alpha, [](const BlockPixel& p) { return p.point.ggx_alpha; });
  write_planes(block, out, out.emission, &SurfacePoint::emission);
  write_plane(block, out, out.material, [](const BlockPixel& p) { return p.material; });
}

}  // namespace

void render_geometry_buffer(const GeometryBufferInputs& inputs, GeometryBuffer& buffer) {
  buffer.resize(inputs.width, inputs.height);
  buffer.camera = inputs.camera;
  buffer.sub_pixel_x = inputs.sub_pixel.x, buffer.sub_pixel_y = inputs.sub_pixel.y;
  const ScreenRays screen(inputs);
  const std::uint32_t columns = (inputs.width + kBlock - 1) / kBlock, rows = (inputs.height + kBlock - 1) / kBlock;
  parallel_for(std::size_t(columns) * rows, 1, [&](std::size_t begin, std::size_t end) {
    Block block;
    for (std::size_t i = begin; i < end; ++i) {
      block.left = static_cast<std::uint32_t>(i % columns) * kBlock;
      block.top = static_cast<std::uint32_t>(i / columns) * kBlock;
      block.width = std::min(kBlock, inputs.width - block.left);
      block.height = std::min(kBlock, inputs.height - block.top);
      for (std::uint32_t y = 0; y < block.height; y += 4) {
        for (std::uint32_t x = 0; x < block.width; x += 4) render_packet(inputs, screen, x, y, block);
      }
      write_block(block, buffer);
    }
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
