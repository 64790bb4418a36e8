// SPDX-License-Identifier: Apache-2.0
#include "real_time/reflective_shadow_map/light_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "equations/cpp/float.h"

namespace luciole {
namespace {

static_assert(kPointMap == word_(PunctualLight::Kind::point) && kSpotMap == word_(PunctualLight::Kind::spot) &&
              kSunMap == word_(PunctualLight::Kind::directional));

constexpr float kPi = std::numbers::pi_v<float>;

// Longer sides than 64 to 1 gain nothing from longer rows of texels, and a flat scene has no other bound.
float aspect(const SunRectangle& r) {
  return r.width > 0 && r.height > 0 ? std::clamp(r.width / r.height, 1 / 64.0f, 64.0f) : 1.0f;
}

}  // namespace

LightMap::LightMap(const PunctualLight& light, std::uint32_t texels, const Bounds& scene_bounds)
    : light_(light),
      frame_(frame_around(light.direction)),
      rectangle_(light.kind == PunctualLight::Kind::directional ? sun_rectangle(light.direction, scene_bounds)
                                                                : SunRectangle{}),
      cells_(texels, aspect(rectangle_)) {
  const float share = texels > 0 ? 1.0f / static_cast<float>(texels) : 0.0f;
  switch (light.kind) {
    case PunctualLight::Kind::point:
      solid_angle_ = 4 * kPi * share;
      break;
    case PunctualLight::Kind::spot:
      solid_angle_ = 2 * kPi * (1 - light.cos_outer) * share;
      break;
    case PunctualLight::Kind::directional:
      parallel_area_ = rectangle_.width * rectangle_.height * share;
      break;
  }
}

TexelRay LightMap::ray(std::uint32_t texel, Vec2 within) const {
  const Vec2 point = cells_.point(texel, within);
  if (light_.kind == PunctualLight::Kind::directional) {
    const Vec3 origin = rectangle_.corner + rectangle_.right * (point.x * rectangle_.width) +
                        rectangle_.up * (point.y * rectangle_.height);
    return {origin, light_.direction, light_.intensity * parallel_area_};
  }
  const Vec3 direction = light_.kind == PunctualLight::Kind::spot
                             ? normalize(frame_.world(f32::cone_direction(point, light_.cos_outer)))
                             : f32::octahedral_direction(point);
  return {light_.position, direction, intensity_towards(light_, direction) * solid_angle_};
}

LightMapRecord LightMap::record(std::uint32_t first_texel) const {
  const auto put = [](Vec3 from, float(&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; };
  const bool sun = light_.kind == PunctualLight::Kind::directional;
  LightMapRecord record{};
  record.kind = static_cast<word_>(light_.kind);
  record.first_texel = first_texel, record.texels = size(), record.rows = cells_.rows();
  put(sun ? rectangle_.corner : light_.position, record.origin);
  put(sun ? rectangle_.right : frame_.right, record.right);
  put(sun ? rectangle_.up : frame_.up, record.up), put(light_.direction, record.axis);
  record.width = rectangle_.width, record.height = rectangle_.height;
  record.cos_outer = light_.cos_outer, record.ramp = ramp_width(light_);
  put(light_.intensity * (sun ? parallel_area_ : solid_angle_), record.flux);
  record.solid_angle = solid_angle_, record.parallel_area = parallel_area_;
  return record;
}

std::vector<std::uint32_t> share_texels(const std::vector<float>& powers, std::uint32_t total) {
  std::vector<std::uint32_t> shares(powers.size(), 0);
  if (powers.empty()) return shares;
  std::vector<double> weights(powers.begin(), powers.end());
  for (double& weight : weights) weight = weight > 0 && std::isfinite(weight) ? weight : 0.0;
  double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0)) {
    std::fill(weights.begin(), weights.end(), 1.0);
    sum = static_cast<double>(weights.size());
  }
  std::uint32_t given = 0;
  std::vector<double> remainders(powers.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double exact = weights[i] / sum * total;
    shares[i] = static_cast<std::uint32_t>(std::min(std::floor(exact), static_cast<double>(total - given)));
    remainders[i] = weights[i] > 0 ? exact - shares[i] : -1.0;
    given += shares[i];
  }
  std::vector<std::size_t> order(powers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return remainders[a] > remainders[b]; });
  for (std::size_t i = 0; given < total; i = (i + 1) % order.size()) {
    if (weights[order[i]] > 0) ++shares[order[i]], ++given;
  }
  return shares;
}

}  // namespace luciole
