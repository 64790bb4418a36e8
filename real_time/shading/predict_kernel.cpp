// SPDX-License-Identifier: Apache-2.0
#include "real_time/shading/predict_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
namespace {

#include "real_time/shading/connection.inc"

// One light at the pixels, as if nothing were culled.
struct Contribution {
  real3 radiance;
  real p;
};

template <class Emitter>
LUCIOLE_FN Contribution contribution(const Pixels& pixels, real3 albedo, const Emitter& light) {
  const Connection c = connect(pixels, light.position);
  const Emitted e = emit(light, -c.to_light);
  const real l_sq = c.distance_sq + light.disc;
  const mask lit = e.peak > 0.0f && dot(pixels.geometric_normal, c.to_light) > 0.0f;
  const real3 arriving = e.colour * select(lit, e.factor / l_sq, real(0.0f));
  const Reflection r = reflection(pixels.brdf, c.to_light);
  Contribution out;
  out.radiance = arriving * (albedo * r.diffuse + r.specular);
  out.p = min(e.peak / l_sq, real(1.0f));
  return out;
}

// L^2 (1/p - 1) = L (L/p - L): 0 where p is.
LUCIOLE_FN real roulette_variance(real l, real inverse_p) { return l * (l * inverse_p - l); }

// Covariance of the two lobes of one light, xi_s = 1 - xi_d: both are accepted with probability max(p_d + p_s - 1, 0).
LUCIOLE_FN real lobe_covariance(real l_d, real l_s, real both_over_product) {
  return l_d * l_s * (both_over_product - 1.0f);
}

LUCIOLE_FN real inverse_or_zero(real p) { return select(p > 0.0f, real(1.0f) / max(p, real(1e-30f)), real(0.0f)); }

struct PredictionSums {
  real3 sum, variance;
  real accepted;
};

LUCIOLE_FN void add(const Contribution& c, real inverse_p, PredictionSums& sums) {
  sums.sum += c.radiance;
  sums.variance += real3(roulette_variance(c.radiance.x, inverse_p), roulette_variance(c.radiance.y, inverse_p),
                         roulette_variance(c.radiance.z, inverse_p));
  sums.accepted += c.p;
}

}  // namespace

void predict_group(const PixelGroup& group, const float (&diffuse_albedo)[3][kGroupPixels], const SubsetLights& lights,
                   GroupPrediction& out) {
  for (int lane = 0; lane < kGroupPixels; lane += kLanes) {
    const Pixels pixels = load_pixels(group, lane);
    const real3 albedo = load3(diffuse_albedo, lane);
    const Contribution nothing{real3(0.0f, 0.0f, 0.0f), real(0.0f)};
    PredictionSums sums;
    for (std::uint32_t i = 0; i < lights.vpl_count; ++i) {
      const Contribution d = lights.diffuse ? contribution(pixels, albedo, lights.diffuse[i]) : nothing;
      const Contribution s = lights.glossy ? contribution(pixels, albedo, lights.glossy[i]) : nothing;
      const real inverse_d = inverse_or_zero(d.p), inverse_s = inverse_or_zero(s.p);
      add(d, inverse_d, sums), add(s, inverse_s, sums);
      const real both = max(d.p + s.p - 1.0f, real(0.0f)) * inverse_d * inverse_s;
      sums.variance +=
          real3(lobe_covariance(d.radiance.x, s.radiance.x, both), lobe_covariance(d.radiance.y, s.radiance.y, both),
                lobe_covariance(d.radiance.z, s.radiance.z, both)) *
          2.0f;
    }
    for (std::uint32_t i = 0; i < lights.many_count; ++i) {
      const Contribution c = contribution(pixels, albedo, lights.many[i]);
      add(c, inverse_or_zero(c.p), sums);
    }
    store3(out.sum, lane, sums.sum);
    store3(out.variance, lane, sums.variance);
    store(out.accepted + lane, sums.accepted);
  }
}

}  // namespace luciole::LUCIOLE_ISA
