// SPDX-License-Identifier: Apache-2.0
// The unit of work of the geometry buffer: 16x16 pixels, traced in packets of 4x4 and evaluated 16 at a time.
#pragma once
#include <cstddef>
#include <cstdint>

#include "ray_tracing/ray_packet.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "scene/make_surface_tables.h"
#include "scene/surface_kernel.h"

namespace luciole {

inline constexpr std::uint32_t kBlock = 16;  // pixels per side: 16 packets, a few textures in the cache
inline constexpr std::uint32_t kPacketsAcross = kBlock / 4, kPackets = kPacketsAcross * kPacketsAcross;
inline constexpr std::uint32_t kBlockPixels = kBlock * kBlock;

// The planes of floats of a geometry buffer.
enum Quantity : std::size_t {
  kDepth,
  kPosition,
  kNormal = kPosition + 3,
  kGeometricNormal = kNormal + 3,
  kDiffuseAlbedo = kGeometricNormal + 3,
  kF0 = kDiffuseAlbedo + 3,
  kF90 = kF0 + 3,
  kGgxAlpha,
  kEmission,
  kQuantities = kEmission + 3
};

// The pixels of one block before they go to the planes, packet after packet: written straight from the packets, two
// dozen planes would be as many streams of short stores, each of which misses caches and address translation.
struct alignas(64) PixelBlock {
  std::uint32_t left, top, width, height;  // of the part inside the screen
  float value[kQuantities][kBlockPixels];
  std::uint32_t material[kBlockPixels];
};

// The plane of pixels at distance 1 in front of the eye. Directions are not unit: their part along `forward` is 1, so
// that distances along them are depths.
struct ScreenRays {
  Vec3 eye, forward, top_left, across, down;
  float pixel_size;  // height of a pixel at distance 1 [m]

  ScreenRays(const Camera& camera, std::uint32_t width, std::uint32_t height, Vec2 sub_pixel);
  Vec3 direction(std::uint32_t x, std::uint32_t y) const {
    return top_left + across * static_cast<float>(x) + down * static_cast<float>(y);
  }
};

// Fills blocks of one frame; used by all threads at once.
class BlockRenderer {
 public:
  explicit BlockRenderer(const GeometryBufferInputs& inputs);
  void render(PixelBlock& block) const;  // reads which part of the screen it is, writes the rest

 private:
  struct MixedPixels;
  HitPacket trace(const PixelBlock& block, std::uint32_t packet, RayPacket& rays) const;
  void render_packet(std::uint32_t packet, PixelBlock& block, MixedPixels& mixed) const;
  void set_sky(Vec3 direction, std::size_t pixel, PixelBlock& block) const;
  void evaluate_packet(const RayPacket& rays, const HitPacket& hits, std::size_t first, PixelBlock& block) const;
  void evaluate_mixed(MixedPixels& mixed, PixelBlock& block) const;

  const RayScene& scene_;
  const ScreenRays screen_;
  const SurfaceTables tables_;
  void (*const evaluate_)(const SurfaceMesh&, const SurfaceQueries&, SurfaceAnswers&);
};

}  // namespace luciole
