// SPDX-License-Identifier: Apache-2.0
#include "offline/path/bsdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luciole {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kInversePi = std::numbers::inv_pi_v<float>;

// A microfacet normal among those that `to_eye` sees, in the frame of the surface normal: a point on the spherical cap
// that the stretched direction sees.   [Dupuy and Benyoub 2023], after [Heitz 2018]
Vec3 visible_normal(Vec3 to_eye, float alpha, Vec2 place) {
  const Vec3 stretched = normalize(Vec3(alpha * to_eye.x, alpha * to_eye.y, to_eye.z));
  const float azimuth = 2 * kPi * place.x;
  const float z = (1 - place.y) * (1 + stretched.z) - stretched.z;
  const float sine = std::sqrt(std::max(1 - z * z, 0.0f));
  const Vec3 half = Vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z) + stretched;
  return normalize(Vec3(alpha * half.x, alpha * half.y, std::max(half.z, 1e-6f)));
}

}  // namespace

TangentFrame::TangentFrame(Vec3 normal) : z(normal) {
  const float sign = std::copysign(1.0f, normal.z);
  const float a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
  x = {1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
  y = {b, sign + normal.y * normal.y * a, -normal.y};
}

Bsdf::Bsdf(const SurfacePoint& point, Vec3 to_eye, float diffuse_share)
    : diffuse_albedo_(point.diffuse_albedo), geometric_normal_(point.geometric_normal), ggx_alpha_(point.ggx_alpha) {
  fixed_ =
      f32::fix_direction({point.diffuse_albedo, point.f0, point.f90, point.ggx_alpha}, point.shading_normal, to_eye);
  const float weight = f32::schlick_weight(fixed_.cos_fixed);
  const float specular = channel_mean(point.f0) * (1 - weight) + point.f90 * weight;
  const float diffuse = channel_mean(point.diffuse_albedo) * (1 - specular);
  // At least a tenth for each lobe that there is: the other's estimate of its share is rough.
  specular_chance_ = diffuse > 0 ? std::clamp(specular / std::max(specular + diffuse, 1e-12f), 0.1f, 0.9f) : 1.0f;
  if (!(specular > 0)) specular_chance_ = 0;
  diffuse_chance_ = (1 - specular_chance_) * diffuse_share;
}

Vec3 Bsdf::evaluate(Vec3 direction) const {
  if (!above(direction)) return {0, 0, 0};
  const f32::Reflection r = f32::reflection(fixed_, direction);
  return diffuse_albedo_ * r.diffuse + r.specular;
}

float Bsdf::pdf(Vec3 direction) const {
  if (!above(direction)) return 0;
  const float cosine = dot(direction, fixed_.normal);
  float density = diffuse_chance_ * cosine * kInversePi;
  if (specular_chance_ > 0) {
    // Visible normals: G1(eye) D / (4 cos_eye), where G1 / (2 cos_eye) = 1 / (cos_eye + masking).   [Heitz 2018]
    const Vec3 half = direction + fixed_.fixed_direction;
    const float half_sq = dot(half, half), along = dot(half, fixed_.normal);
    const Vec3 across = half - fixed_.normal * along;
    const float d = f32::ggx_distribution(fixed_.alpha_sq, along * along / half_sq, dot(across, across) / half_sq);
    density += specular_chance_ * 0.5f * d / (fixed_.cos_fixed + fixed_.masking);
  }
  return density;
}

BsdfSample Bsdf::sample(Vec2 place, float lobe) const {
  const TangentFrame frame(fixed_.normal);
  Vec3 direction;
  if (lobe < specular_chance_) {
    const Vec3 to_eye = fixed_.fixed_direction;
    const Vec3 normal = frame.world(visible_normal(frame.local(to_eye), ggx_alpha_, place));
    direction = normalize(normal * (2 * dot(normal, to_eye)) - to_eye);
  } else {
    if (lobe >= specular_chance_ + diffuse_chance_) return {};
    const float radius = std::sqrt(place.y), azimuth = 2 * kPi * place.x;
    direction = frame.world(
        Vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(std::max(1 - place.y, 0.0f))));
  }
  BsdfSample sample;
  const float density = pdf(direction);
  if (!(density > 0) || !std::isfinite(density)) return sample;
  sample.direction = direction;
  sample.weight = evaluate(direction) / density;
  sample.pdf = density;
  return sample;
}

}  // namespace luciole
