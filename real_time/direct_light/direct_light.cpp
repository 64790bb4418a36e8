// SPDX-License-Identifier: Apache-2.0
#include "real_time/direct_light/direct_light.h"

#include <algorithm>
#include <limits>

#include "base/isa.h"
#include "base/parallel.h"
#include "real_time/direct_light/direct_light_kernel.h"
#include "real_time/direct_light/direct_sources.h"

namespace luciole {
namespace {

constexpr std::size_t kGrain = 64;  // groups of 16 pixels per unit of work

void copy(Vec3 from, float (&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }
void point_to(const Plane3& from, const float* (&to)[3]) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis].data();
}

DirectPixels planes_of(const GeometryBuffer& geometry) {
  DirectPixels pixels;
  point_to(geometry.position, pixels.position);
  point_to(geometry.normal, pixels.normal);
  point_to(geometry.geometric_normal, pixels.geometric_normal);
  point_to(geometry.diffuse_albedo, pixels.diffuse_albedo);
  point_to(geometry.f0, pixels.f0);
  pixels.f90 = geometry.f90.data();
  pixels.ggx_alpha = geometry.ggx_alpha.data();
  copy(geometry.camera.eye, pixels.eye);
  return pixels;
}

// Lights and the planes that they light.
struct DirectPass {
  const RayScene& rays;
  const GeometryBuffer& geometry;
  DirectPixels pixels;
  PrimaryLights lights;
  std::vector<DirectSource> sources;
  Isa isa;
};

Vec3 vector_at(const Plane3& planes, std::size_t at) { return {planes[0][at], planes[1][at], planes[2][at]}; }

// Those of the lit lanes that see the light.
std::uint32_t unshadowed(const DirectPass& pass, const PunctualLight& light, std::size_t first, std::uint32_t lit) {
  RayPacket packet;
  for (int lane = 0; lane < kPacketRays; ++lane) {
    if ((lit >> lane & 1) == 0) {
      packet.skip(lane);
      continue;
    }
    const std::size_t at = first + static_cast<std::size_t>(lane);
    const Vec3 origin = pass.rays.offset_from_surface(vector_at(pass.geometry.position, at),
                                                      vector_at(pass.geometry.geometric_normal, at));
    if (light.kind == PunctualLight::Kind::directional) {
      packet.set(lane, origin, -light.direction, 0, std::numeric_limits<float>::infinity());
    } else {
      packet.set(lane, origin, light.position - origin, 0, 1);
    }
  }
  return lit & ~pass.rays.occluded(packet, Coherence::coherent);
}

void light_group(const DirectPass& pass, std::size_t first, Plane3& out) {
  const std::size_t count = std::min<std::size_t>(kDirectLanes, pass.geometry.pixel_count() - first);
  float sum[3][kDirectLanes] = {};
  for (std::size_t i = 0; i < pass.sources.size(); ++i) {
    DirectReflection reflected;
    LUCIOLE_FOR_ISA(pass.isa, reflect_source(pass.pixels, first, pass.sources[i], reflected));
    reflected.lit &= count == kDirectLanes ? 0xffffu : (1u << count) - 1;
    if (reflected.lit == 0) continue;
    const std::uint32_t seen = unshadowed(pass, pass.lights[i], first, reflected.lit);
    for (int lane = 0; lane < kDirectLanes; ++lane) {
      if ((seen >> lane & 1) == 0) continue;
      for (int channel = 0; channel < 3; ++channel) sum[channel][lane] += reflected.radiance[channel][lane];
    }
  }
  for (int channel = 0; channel < 3; ++channel) {
    std::copy_n(sum[channel], count, out[channel].begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace

Plane3 direct_light(const RayScene& rays, const GeometryBuffer& geometry, const PrimaryLights& primaries, Isa isa) {
  const PrimaryLights lights = direct_lights(rays.scene(), primaries);
  const DirectPass pass{rays, geometry, planes_of(geometry), lights, direct_sources(lights), isa};
  Plane3 radiance;
  for (Plane& plane : radiance) plane.resize(geometry.pixel_count());
  const std::size_t groups = (geometry.pixel_count() + kDirectLanes - 1) / kDirectLanes;
  parallel_for(groups, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group) light_group(pass, group * kDirectLanes, radiance);
  });
  return radiance;
}

}  // namespace luciole
