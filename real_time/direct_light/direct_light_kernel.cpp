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
void reflect_lanes(const DirectPixels& pixels, std::size_t at, const DirectSource& source, int lane,
                   DirectReflection& out) {
  const real3 position = load3(pixels.position, at), geometric_normal = load3(pixels.geometric_normal, at);
  const real3 to_eye = normalize(broadcast(pixels.eye) - position);
  const real3 offset = broadcast(source.position) - position;
  const real3 away = broadcast(source.direction);
  // Closer than a micrometre the fall-off stays what it is there.
  const real distance_sq = source.sun ? real(1.0f) : max(dot(offset, offset), real(1e-12f));
  const real3 to_light = source.sun ? -away : offset * inverse_sqrt(distance_sq);
  const real t = clamp(-dot(to_light, away) * real(source.scale) + real(source.offset), real(0.0f), real(1.0f));
  const real received = t * t / distance_sq;

  SurfaceBrdf brdf;
  brdf.diffuse_albedo = load3(pixels.diffuse_albedo, at);
  brdf.f0 = load3(pixels.f0, at);
  brdf.f90 = load(pixels.f90 + at);
  brdf.ggx_alpha = load(pixels.ggx_alpha + at);
  const Reflection reflected = reflection(fix_direction(brdf, load3(pixels.normal, at), to_eye), to_light);
  const real3 radiance =
      (brdf.diffuse_albedo * reflected.diffuse + reflected.specular) * broadcast(source.colour) * received;

  const real zero(0.0f);
  const mask lit = dot(geometric_normal, to_light) > zero && dot(geometric_normal, to_eye) > zero &&
                   (radiance.x + radiance.y + radiance.z) > zero;
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
