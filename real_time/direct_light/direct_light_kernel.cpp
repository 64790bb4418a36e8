// SPDX-License-Identifier: Apache-2.0
#include "real_time/direct_light/direct_light_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
namespace {

real3 load3(const float* const (&planes)[3], std::size_t at) {
  return real3(load(planes[0] + at), load(planes[1] + at), load(planes[2] + at));
}
real3 broadcast(const float (&v)[3]) { return real3(real(v[0]), real(v[1]), real(v[2])); }

// One register of pixels.
void reflect_lanes(const DirectPixels& pixels, std::size_t at, const DirectSource& from, int lane,
                   DirectReflection& out) {
  const real3 position = load3(pixels.position, at);
  SurfaceBrdf brdf;
  brdf.diffuse_albedo = load3(pixels.diffuse_albedo, at);
  brdf.f0 = load3(pixels.f0, at);
  brdf.f90 = load(pixels.f90 + at);
  brdf.ggx_alpha = load(pixels.ggx_alpha + at);
  PunctualSource source;
  source.sun = mask_from_bits(from.sun != 0 ? ~0u : 0u);
  source.position = broadcast(from.position), source.direction = broadcast(from.direction);
  source.colour = broadcast(from.colour);
  source.scale = real(from.scale), source.offset = real(from.offset);
  const real3 radiance = reflected_from_source(source, brdf, position, load3(pixels.geometric_normal, at),
                                               load3(pixels.normal, at), normalize(broadcast(pixels.eye) - position));
  const real zero(0.0f);
  const mask lit = (radiance.x + radiance.y + radiance.z) > zero;
  store(out.radiance[0] + lane, select(lit, radiance.x, zero));
  store(out.radiance[1] + lane, select(lit, radiance.y, zero));
  store(out.radiance[2] + lane, select(lit, radiance.z, zero));
  out.lit |= lane_bits(lit) << lane;
}

}  // namespace

void reflect_source(const DirectPixels& pixels, std::size_t first, const DirectSource& source, DirectReflection& out) {
  out.lit = 0;
  for (int lane = 0; lane < kDirectLanes; lane += kLanes) {
    reflect_lanes(pixels, first + static_cast<std::size_t>(lane), source, lane, out);
  }
}

}  // namespace luciole::LUCIOLE_ISA
