// SPDX-License-Identifier: Apache-2.0
#include "real_time/geometry_buffer/geometry_buffer_pass.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "equations/cpp/float.h"
#include "real_time/fold_seed.h"
#include "real_time/geometry_buffer/sky.h"
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

void set(Plane3& planes, std::size_t at, Vec3 value) {
  planes[0][at] = value.x, planes[1][at] = value.y, planes[2][at] = value.z;
}

void write_surface(const SurfacePoint& point, float depth, std::uint32_t material, std::size_t at,
                   GeometryBuffer& out) {
  out.depth[at] = depth;
  set(out.position, at, point.position);
  set(out.normal, at, point.shading_normal);
  set(out.geometric_normal, at, point.geometric_normal);
  set(out.diffuse_albedo, at, point.diffuse_albedo);
  set(out.f0, at, point.f0);
  out.f90[at] = point.f90;
  out.ggx_alpha[at] = point.ggx_alpha;
  set(out.emission, at, point.emission);
  out.material[at] = material;
}

void write_sky(Vec3 radiance, std::size_t at, GeometryBuffer& out) {
  SurfacePoint nothing{};
  nothing.ggx_alpha = 1;
  nothing.emission = radiance;
  write_surface(nothing, kNoSurface, kNoMaterial, at, out);
}

// Starts to fetch what the surfaces of a packet are made of: first the corners of all triangles, then their vertices.
// One pixel after the other would wait for memory 16 times over.
void prefetch_surfaces(const Scene& scene, const HitPacket& hits) {
  for (int lane = 0; lane < kPacketRays; ++lane) {
    if (hits.mesh[lane] == kNoHit) continue;
    __builtin_prefetch(&scene.meshes[hits.mesh[lane]].indices[std::size_t(hits.triangle[lane]) * 3]);
  }
  for (int lane = 0; lane < kPacketRays; ++lane) {
    if (hits.mesh[lane] == kNoHit) continue;
    const Mesh& mesh = scene.meshes[hits.mesh[lane]];
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t index = mesh.indices[std::size_t(hits.triangle[lane]) * 3 + static_cast<std::size_t>(corner)];
      __builtin_prefetch(&mesh.positions[index]);
      if (!mesh.normals.empty()) __builtin_prefetch(&mesh.normals[index]);
      if (!mesh.tangents.empty()) __builtin_prefetch(&mesh.tangents[index]);
      if (!mesh.uv[0].empty()) __builtin_prefetch(&mesh.uv[0][index]);
    }
  }
}

// Traces and writes the 4x4 pixels from (x0, y0) on.
void render_packet(const GeometryBufferInputs& inputs, const ScreenRays& screen, std::uint32_t x0, std::uint32_t y0,
                   GeometryBuffer& out) {
  RayPacket rays;
  Vec3 directions[kPacketRays];
  for (std::uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const std::uint32_t x = x0 + lane % 4, y = y0 + lane / 4;
    directions[lane] = screen.direction(x, y);
    rays.set(static_cast<int>(lane), inputs.camera.eye, directions[lane], 0, kNoSurface);
    if (x >= out.width || y >= out.height) rays.active[lane] = 0;
  }
  const HitPacket hits = inputs.scene.intersect(rays, Coherence::coherent);
  const Scene& scene = inputs.scene.scene();
  prefetch_surfaces(scene, hits);
  for (std::uint32_t lane = 0; lane < kPacketRays; ++lane) {
    if (rays.active[lane] == 0) continue;
    const std::size_t at = std::size_t(y0 + lane / 4) * out.width + (x0 + lane % 4);
    const Vec3 direction = normalize(directions[lane]);
    if (hits.mesh[lane] == kNoHit) {
      write_sky(sky_radiance(scene.environment, direction), at, out);
      continue;
    }
    const SurfaceHit hit{hits.mesh[lane], hits.triangle[lane], hits.u[lane], hits.v[lane]};
    const float cone_width = screen.pixel_size * hits.distance[lane];
    const SurfacePoint point = evaluate_surface(scene, hit, direction, cone_width);
    const float depth = dot(point.position - inputs.camera.eye, inputs.camera.forward);
    write_surface(point, depth, scene.meshes[hit.mesh].material, at, out);
  }
}

}  // namespace

void render_geometry_buffer(const GeometryBufferInputs& inputs, GeometryBuffer& buffer) {
  buffer.resize(inputs.width, inputs.height);
  buffer.camera = inputs.camera;
  buffer.sub_pixel_x = inputs.sub_pixel.x, buffer.sub_pixel_y = inputs.sub_pixel.y;
  const ScreenRays screen(inputs);
  const std::uint32_t columns = (inputs.width + kBlock - 1) / kBlock, rows = (inputs.height + kBlock - 1) / kBlock;
  parallel_for(std::size_t(columns) * rows, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const auto left = static_cast<std::uint32_t>(block % columns) * kBlock;
      const auto top = static_cast<std::uint32_t>(block / columns) * kBlock;
      for (std::uint32_t y = top; y < std::min(top + kBlock, inputs.height); y += 4) {
        for (std::uint32_t x = left; x < std::min(left + kBlock, inputs.width); x += 4) {
          render_packet(inputs, screen, x, y, buffer);
        }
      }
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
