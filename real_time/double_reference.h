// SPDX-License-Identifier: Apache-2.0
// For tests: what culling and shading must give, in double precision and without culling, from the emitters that the
// engines read.
#pragma once
#include <array>
#include <vector>

#include "equations/cpp/double.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/light_range/reaching_lights.h"
#include "real_time/shading/shading_pass.h"

namespace luciole::test {

struct DoublePixel {
  std::array<double, 6> light{};  // demodulated diffuse and specular, with the weight n^2
  std::uint32_t accepted = 0;
  bool at_a_tie = false;  // some |p/xi - 1| < 1e-5: float may decide either way
  double ties = 0;        // how many of those are to be expected of random xi
};

inline f64::real3 wide(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
inline f64::real3 wide(const Plane3& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }

inline f64::FixedDirectionBrdf lobe_of(const float (&normal)[3], const float (&incident)[3]) {
  f64::FixedDirectionBrdf f;
  f.normal = wide(normal), f.fixed_direction = wide(incident);
  return f;
}

inline f64::Emitted emission(const DiffuseEmitter& light, f64::real3 from_light) {
  f64::FixedDirectionBrdf f = lobe_of(light.normal, light.incident);
  f.f0_max = light.f0_max, f.f90 = light.f90;
  return f64::emitted_by_diffuse_lobe(f, wide(light.geometric_normal), wide(light.intensity), light.probability_scale,
                                      from_light);
}

inline f64::Emitted emission(const GlossyEmitter& light, f64::real3 from_light) {
  f64::FixedDirectionBrdf f = lobe_of(light.normal, light.incident);
  f.f0 = wide(light.f0), f.f90 = light.f90, f.f0_max = 0;
  f.alpha_sq = light.alpha_sq, f.cos_fixed = light.cos_incident, f.masking = light.masking;
  return f64::emitted_by_glossy_lobe(f, wide(light.geometric_normal), wide(light.flux), light.probability_scale,
                                     from_light);
}

inline f64::Emitted emission(const ManyEmitter& light, f64::real3 from_light) {
  const f64::AxialEmission a{wide(light.axis), light.scale, light.offset, light.two_sided, light.squared};
  return f64::emitted_along_axis(a, wide(light.intensity), light.probability_scale, from_light);
}

template <class Emitter>
void add_light(const f64::FixedDirectionBrdf& surface, f64::real3 position, f64::real3 geometric_normal,
               const Emitter& light, double weight, DoublePixel& pixel) {
  const f64::real3 d = wide(light.position) - position;
  const double distance_sq = f64::dot(d, d), l_sq = distance_sq + light.disc;
  const f64::real3 to_light = d * f64::inverse_sqrt(distance_sq);
  const f64::Emitted e = emission(light, -to_light);
  const double p = e.peak / l_sq;  // not cut at 1: xi is below 1
  constexpr double kTie = 1e-5;
  if (std::abs(p / light.xi - 1) < kTie) pixel.at_a_tie = true;
  if (p < 1) pixel.ties += 2 * kTie * p;
  if (!f64::emission_is_accepted(e, l_sq, light.xi)) return;
  ++pixel.accepted;
  if (!(f64::dot(geometric_normal, to_light) > 0)) return;
  const f64::real3 arriving = e.colour * (e.factor * f64::fall_off_over_probability(e, l_sq) * weight);
  const f64::Reflection r = f64::reflection(surface, to_light);
  const f64::real3 diffuse = arriving * r.diffuse, specular = arriving * r.specular;
  const double add[6] = {diffuse.x, diffuse.y, diffuse.z, specular.x, specular.y, specular.z};
  for (int i = 0; i < 6; ++i) pixel.light[i] += add[i];
}

// One kind of light at all pixels, stochastic ranges.  shift: as in ShadingInputs
template <class Emitter>
void add_lights(const GeometryBuffer& g, const ReachingLights<Emitter>& lights, std::uint32_t interleave,
                std::uint32_t shift, std::vector<DoublePixel>& pixels) {
  if (lights.emitters.empty()) return;
  for (std::size_t i = 0; i < g.pixel_count(); ++i) {
    if (g.depth[i] == kNoSurface) continue;
    const f64::real3 position = wide(g.position, i);
    const f64::real3 eye{g.camera.eye.x, g.camera.eye.y, g.camera.eye.z};
    f64::SurfaceBrdf brdf;
    brdf.f0 = wide(g.f0, i), brdf.f90 = g.f90[i], brdf.ggx_alpha = g.ggx_alpha[i];
    const auto surface = f64::fix_direction(brdf, wide(g.normal, i), f64::normalize(eye - position));
    const auto x = static_cast<std::uint32_t>(i % g.width), y = static_cast<std::uint32_t>(i / g.width);
    const std::uint32_t region = y % interleave * interleave + x % interleave;
    const std::uint32_t subset = (region + shift) % (interleave * interleave);
    for (std::uint32_t k = 0; k < lights.count[subset]; ++k) {
      add_light(surface, position, wide(g.geometric_normal, i), lights.emitters[lights.begin[subset] + k],
                double(interleave * interleave), pixels[i]);
    }
  }
}

}  // namespace luciole::test
