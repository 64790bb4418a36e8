// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/weigh_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
namespace {

LUCIOLE_FN real3 broadcast(const float v[3]) { return real3(v[0], v[1], v[2]); }

// Part of a smooth surface's mirror image that lies beside the mirrored centre: keeps a weight above 0 where the lobe
// at the light's centre is black but its rim is not. What it misses multiple importance sampling finds.
constexpr float kSpecularFloor = 0.02f;
constexpr float kRounding = 1 - 1e-4f;  // so that rounding never loses a light whose rim is in reach

struct WideLights {
  real3 centre, axis;
  real radius, intensity, scale, offset, two_sided, lamp, xi;
};

LUCIOLE_FN WideLights load_lights(const LightRowsView& rows, std::uint32_t first) {
  const auto row = [&](LightRowsView::Row r) { return load(rows.row[r] + first); };
  WideLights w;
  w.centre = real3(row(LightRowsView::kX), row(LightRowsView::kY), row(LightRowsView::kZ));
  w.axis = real3(row(LightRowsView::kAxisX), row(LightRowsView::kAxisY), row(LightRowsView::kAxisZ));
  w.radius = row(LightRowsView::kRadius), w.intensity = row(LightRowsView::kIntensity);
  w.scale = row(LightRowsView::kScale), w.offset = row(LightRowsView::kOffset);
  w.two_sided = row(LightRowsView::kTwoSided), w.lamp = row(LightRowsView::kLamp), w.xi = row(LightRowsView::kXi);
  return w;
}

// GGX reflection towards the light's centre, the lobe widened by the angle that the light fills, so that it does not
// miss a light whose centre it misses.
LUCIOLE_FN real specular_reflection(const Receiver& at, real3 normal, real3 to_light, real radius_sq_over_distance_sq) {
  const real3 to_eye = broadcast(at.to_eye);
  SurfaceBrdf brdf;
  brdf.diffuse_albedo = real3(0.0f, 0.0f, 0.0f);
  brdf.f0 = real3(at.f0, at.f0, at.f0), brdf.f90 = at.f90;
  brdf.ggx_alpha = sqrt(min(real(at.ggx_alpha * at.ggx_alpha) + 0.25f * radius_sq_over_distance_sq, real(1.0f)));
  return reflection(fix_direction(brdf, normal, to_eye), to_light).specular.x;
}

template <Weight weight>
LUCIOLE_FN real weigh(const WideLights& light, const Receiver& at, real radiance_floor) {
  const real3 normal = broadcast(at.shading_normal);
  const real3 apart = light.centre - broadcast(at.position);
  const real distance_sq = max(dot(apart, apart), real(1e-30f));
  const real inverse_distance = inverse_sqrt(distance_sq);
  const real distance = distance_sq * inverse_distance;
  const real3 to_light = apart * inverse_distance;
  const real near_sq = max(distance_sq, light.radius * light.radius);
  const real cos_axis = real(0.0f) - dot(light.axis, to_light);
  const real t =
      clamp(max(cos_axis, (real(0.0f) - cos_axis) * light.two_sided) * light.scale + light.offset, 0.0f, 1.0f);
  const real s = select(light.lamp > 0.0f, t * t, t);
  // Of the point of the light's sphere that is highest above the surface: no light that peeps over the horizon is lost.
  const real cos_highest = min((dot(normal, apart) + light.radius) / (distance + light.radius), 1.0f);
  // Can any point of the light be in reach, I s / l^2 > xi floor? Over a triangle s l, the distance to its plane, is
  // the same for all points, and l is at least the centre's less the radius.
  const real least = max(distance - light.radius, real(0.0f));
  const mask in_reach =
      light.intensity * s * distance > (light.xi * radiance_floor) * (kRounding * least) * (least * least);
  const mask shines = in_reach && (s > 0.0f) && (cos_highest > 0.0f) &&
                      (dot(broadcast(at.geometric_normal), apart) + light.radius > 0.0f);
  const real unoccluded = light.intensity * s * inverse(near_sq);
  if constexpr (weight == Weight::printed) {
    return select(shines, unoccluded * cos_highest, real(0.0f));
  } else {
    const real spread = light.radius * light.radius * inverse(near_sq);
    const float matte = (at.diffuse + kSpecularFloor * (at.f0 + at.f90)) * 0.318309886f;
    const real reflected = real(matte) * cos_highest + specular_reflection(at, normal, to_light, spread);
    return select(shines, reflected * max(unoccluded, radiance_floor), real(0.0f));
  }
}

}  // namespace

void weigh_lights(const LightRowsView& lights, const Receiver& receiver, Weight weight, float radiance_floor,
                  float* weights) {
  for (std::uint32_t first = 0; first < lights.count; first += kLanes) {
    const WideLights wide = load_lights(lights, first);
    store(weights + first, weight == Weight::printed ? weigh<Weight::printed>(wide, receiver, radiance_floor)
                                                     : weigh<Weight::reflected>(wide, receiver, radiance_floor));
  }
}

}  // namespace luciole::LUCIOLE_ISA
