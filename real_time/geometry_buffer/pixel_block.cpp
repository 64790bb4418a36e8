// SPDX-License-Identifier: Apache-2.0
#include "real_time/geometry_buffer/pixel_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "scene/sky.h"

namespace luciole {
namespace {

constexpr std::uint32_t kNoMaterial = 0xffffffffu;

Isa known(Isa wanted) { return wanted == Isa::automatic ? *choose_isa(wanted) : wanted; }

// Whether 16 lanes met the same mesh, and there is one.
bool is_uniform(const HitPacket& hits) {
  std::uint32_t different = 0;
  for (std::uint32_t mesh : hits.mesh) different |= mesh ^ hits.mesh[0];
  return different == 0 && hits.mesh[0] != kNoHit;
}

// What the kernel writes, in the order of Quantity. Depth is that of the point, not of the ray, which rounds otherwise.
struct Evaluated {
  SurfaceAnswers answers;
  alignas(64) float depth[kSurfaceLanes];

  void set_depth(const ScreenRays& screen) {
    for (int i = 0; i < kSurfaceLanes; ++i) {
      depth[i] = (answers.position[0][i] - screen.eye.x) * screen.forward.x +
                 (answers.position[1][i] - screen.eye.y) * screen.forward.y +
                 (answers.position[2][i] - screen.eye.z) * screen.forward.z;
    }
  }
  std::array<const float*, kQuantities> rows() const {
    std::array<const float*, kQuantities> row{};
    row[kDepth] = depth, row[kF90] = answers.f90, row[kGgxAlpha] = answers.ggx_alpha;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[kPosition + axis] = answers.position[axis];
      row[kNormal + axis] = answers.shading_normal[axis];
      row[kGeometricNormal + axis] = answers.geometric_normal[axis];
      row[kDiffuseAlbedo + axis] = answers.diffuse_albedo[axis];
      row[kF0 + axis] = answers.f0[axis];
      row[kEmission + axis] = answers.emission[axis];
    }
    return row;
  }
};

}  // namespace

ScreenRays::ScreenRays(const Camera& camera, std::uint32_t width, std::uint32_t height, Vec2 sub_pixel) {
  const float half_height = std::tan(0.5f * camera.vertical_fov);
  eye = camera.eye, forward = camera.forward;
  pixel_size = 2 * half_height / static_cast<float>(height);
  across = camera.right * pixel_size, down = camera.up * -pixel_size;
  top_left = camera.forward - across * (0.5f * static_cast<float>(width)) - down * (0.5f * static_cast<float>(height)) +
             across * sub_pixel.x + down * sub_pixel.y;
}

// The pixels of packets that meet several meshes, which wait for others of their mesh. Their order is kept, so that the
// same lanes meet in any run.
struct BlockRenderer::MixedPixels {
  struct Pixel {
    std::uint32_t number, mesh, triangle;
    float u, v, distance;
    Vec3 direction;
  };
  Pixel pixel[kBlockPixels];
  std::uint32_t waiting[kBlockPixels];  // indices in `pixel`
  std::uint32_t count = 0;              // of those that wait

  void add(const RayPacket& rays, const HitPacket& hits, std::uint32_t lane, std::uint32_t number) {
    waiting[count] = count;
    pixel[count++] = {number,
                      hits.mesh[lane],
                      hits.triangle[lane],
                      hits.u[lane],
                      hits.v[lane],
                      hits.distance[lane],
                      Vec3(rays.direction_x[lane], rays.direction_y[lane], rays.direction_z[lane])};
  }
  // The first that waits and up to 15 others of its mesh, in order; returns how many.
  int take(const Pixel* (&taken)[kSurfaceLanes]) {
    const std::uint32_t wanted = pixel[waiting[0]].mesh;
    int lanes = 0;
    std::uint32_t left = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Pixel& candidate = pixel[waiting[i]];
      if (lanes < kSurfaceLanes && candidate.mesh == wanted) {
        taken[lanes++] = &candidate;
      } else {
        waiting[left++] = waiting[i];
      }
    }
    count = left;
    return lanes;
  }
};

BlockRenderer::BlockRenderer(const GeometryBufferInputs& inputs)
    : scene_(inputs.scene),
      screen_(inputs.camera, inputs.width, inputs.height, inputs.sub_pixel),
      tables_(inputs.scene.scene()),
      evaluate_(LUCIOLE_FOR_ISA(known(inputs.isa), evaluate_surfaces)) {}

HitPacket BlockRenderer::trace(const PixelBlock& block, std::uint32_t packet, RayPacket& rays) const {
  const std::uint32_t x0 = packet % kPacketsAcross * 4, y0 = packet / kPacketsAcross * 4;
  for (std::uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const std::uint32_t x = x0 + lane % 4, y = y0 + lane / 4;
    rays.set(static_cast<int>(lane), screen_.eye, screen_.direction(block.left + x, block.top + y), 0, kNoSurface);
    if (x >= block.width || y >= block.height) rays.active[lane] = 0;
  }
  return scene_.intersect(rays, Coherence::coherent);
}

void BlockRenderer::set_sky(Vec3 direction, std::size_t pixel, PixelBlock& block) const {
  const Vec3 radiance = sky_radiance(scene_.scene().environment, normalize(direction));
  for (auto& quantity : block.value) quantity[pixel] = 0;
  block.value[kDepth][pixel] = kNoSurface;
  block.value[kGgxAlpha][pixel] = 1;
  block.value[kEmission][pixel] = radiance.x;
  block.value[kEmission + 1][pixel] = radiance.y;
  block.value[kEmission + 2][pixel] = radiance.z;
  block.material[pixel] = kNoMaterial;
}

void BlockRenderer::evaluate_packet(const RayPacket& rays, const HitPacket& hits, std::size_t first,
                                    PixelBlock& block) const {
  SurfaceQueries queries;
  std::copy_n(hits.triangle, kSurfaceLanes, queries.triangle);
  std::copy_n(hits.u, kSurfaceLanes, queries.u);
  std::copy_n(hits.v, kSurfaceLanes, queries.v);
  std::copy_n(rays.direction_x, kSurfaceLanes, queries.ray_direction[0]);
  std::copy_n(rays.direction_y, kSurfaceLanes, queries.ray_direction[1]);
  std::copy_n(rays.direction_z, kSurfaceLanes, queries.ray_direction[2]);
  for (int i = 0; i < kSurfaceLanes; ++i) queries.cone_width[i] = screen_.pixel_size * hits.distance[i];
  Evaluated evaluated;
  evaluate_(tables_.mesh(hits.mesh[0]), queries, evaluated.answers);
  evaluated.set_depth(screen_);
  const auto rows = evaluated.rows();
  for (std::size_t q = 0; q < kQuantities; ++q) std::copy_n(rows[q], kSurfaceLanes, block.value[q] + first);
  std::fill_n(block.material + first, kSurfaceLanes, scene_.scene().meshes[hits.mesh[0]].material);
}

void BlockRenderer::evaluate_mixed(MixedPixels& mixed, PixelBlock& block) const {
  while (mixed.count > 0) {
    const MixedPixels::Pixel* taken[kSurfaceLanes];
    const int count = mixed.take(taken);
    const std::uint32_t mesh = taken[0]->mesh;
    SurfaceQueries queries;
    for (int i = 0; i < kSurfaceLanes; ++i) {
      const MixedPixels::Pixel& pixel = *taken[i < count ? i : 0];
      queries.triangle[i] = pixel.triangle;
      queries.u[i] = pixel.u, queries.v[i] = pixel.v;
      queries.ray_direction[0][i] = pixel.direction.x;
      queries.ray_direction[1][i] = pixel.direction.y;
      queries.ray_direction[2][i] = pixel.direction.z;
      queries.cone_width[i] = screen_.pixel_size * pixel.distance;
    }
    Evaluated evaluated;
    evaluate_(tables_.mesh(mesh), queries, evaluated.answers);
    evaluated.set_depth(screen_);
    const auto rows = evaluated.rows();
    for (std::size_t q = 0; q < kQuantities; ++q) {
      for (int i = 0; i < count; ++i) block.value[q][taken[i]->number] = rows[q][i];
    }
    for (int i = 0; i < count; ++i) block.material[taken[i]->number] = scene_.scene().meshes[mesh].material;
  }
}

void BlockRenderer::render_packet(std::uint32_t packet, PixelBlock& block, MixedPixels& mixed) const {
  RayPacket rays;
  const HitPacket hits = trace(block, packet, rays);
  const std::uint32_t first = packet * kPacketRays;
  if (is_uniform(hits)) return evaluate_packet(rays, hits, first, block);
  for (std::uint32_t lane = 0; lane < kPacketRays; ++lane) {
    if (rays.active[lane] == 0) continue;
    if (hits.mesh[lane] == kNoHit) {
      set_sky(Vec3(rays.direction_x[lane], rays.direction_y[lane], rays.direction_z[lane]), first + lane, block);
    } else {
      mixed.add(rays, hits, lane, first + lane);
    }
  }
}

void BlockRenderer::render(PixelBlock& block) const {
  MixedPixels mixed;
  for (std::uint32_t packet = 0; packet < kPackets; ++packet) {
    const bool inside = packet % kPacketsAcross * 4 < block.width && packet / kPacketsAcross * 4 < block.height;
    if (inside) render_packet(packet, block, mixed);
  }
  evaluate_mixed(mixed, block);
}

}  // namespace luciole
