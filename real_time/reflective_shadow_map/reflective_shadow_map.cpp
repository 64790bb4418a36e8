// SPDX-License-Identifier: Apache-2.0
#include "real_time/reflective_shadow_map/reflective_shadow_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "equations/cpp/float.h"
#include "scene/surface.h"

namespace luciole {
namespace {

constexpr std::uint32_t kDimensionTexel = 5;  // apart from ranges and emissive points: seeds may be equal
constexpr std::size_t kGrain = 16;            // packets per unit of work

// Below this cosine the surface of a texel is a strip longer than 10,000 times its width: its area stays that.
constexpr float kLeastCosine = 1e-4f;

Vec2 place_in_texel(const TexelSampling& sampling, std::uint32_t key) {
  if (!sampling.is_random()) return {0.5f, 0.5f};
  const f32::RandomWords words =
      f32::random_words(folded(sampling.vpl_seed), sampling.frame_word(), key, kDimensionTexel);
  return {f32::unit_real(words.first), f32::unit_real(words.second)};
}

SurfaceTexel surface_texel(const SurfacePoint& point, const TexelRay& ray, float cross_section) {
  SurfaceTexel texel;
  texel.position = point.position;
  texel.normal = point.shading_normal;
  texel.geometric_normal = point.geometric_normal;
  texel.incident = -ray.direction;
  texel.flux = ray.flux;
  texel.diffuse_albedo = point.diffuse_albedo;
  texel.f0 = point.f0;
  texel.f90 = point.f90;
  texel.ggx_alpha = point.ggx_alpha;
  texel.area = cross_section / std::max(dot(texel.incident, texel.geometric_normal), kLeastCosine);
  return texel;
}

}  // namespace

ReflectiveShadowMaps::ReflectiveShadowMaps(const PrimaryLights& lights, const Bounds& scene_bounds,
                                           std::uint32_t texels) {
  std::vector<float> powers;
  for (const PunctualLight& light : lights) powers.push_back(power(light, scene_bounds));
  const std::vector<std::uint32_t> shares = share_texels(powers, texels);
  first_.push_back(0);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    maps_.emplace_back(lights[i], shares[i], scene_bounds);
    first_.push_back(first_.back() + shares[i]);
  }
}

const LightMap& ReflectiveShadowMaps::map_of(std::uint32_t key, std::uint32_t& texel) const {
  const auto next = std::upper_bound(first_.begin(), first_.end(), key);
  const auto map = static_cast<std::size_t>(next - first_.begin()) - 1;
  texel = key - first_[map];
  return maps_[map];
}

void ReflectiveShadowMaps::trace_packet(const RayScene& scene, const TexelSampling& sampling, std::uint32_t first_key,
                                        std::vector<SurfaceTexel>& texels) const {
  RayPacket rays;
  TexelRay texel_rays[kPacketRays];
  const LightMap* maps[kPacketRays] = {};
  const auto count = static_cast<int>(std::min<std::uint32_t>(texel_count() - first_key, kPacketRays));
  for (int lane = 0; lane < kPacketRays; ++lane) {
    if (lane >= count) {
      rays.skip(lane);
      continue;
    }
    const std::uint32_t key = first_key + static_cast<std::uint32_t>(lane);
    std::uint32_t texel = 0;
    maps[lane] = &map_of(key, texel);
    texel_rays[lane] = maps[lane]->ray(texel, place_in_texel(sampling, key));
    rays.set(lane, texel_rays[lane].origin, texel_rays[lane].direction, 0, std::numeric_limits<float>::infinity());
  }
  const HitPacket hits = scene.intersect(rays, Coherence::coherent);
  for (int lane = 0; lane < count; ++lane) {
    SurfaceTexel& out = texels[first_key + static_cast<std::uint32_t>(lane)];
    out = SurfaceTexel{};
    if (hits.mesh[lane] == kNoHit) continue;
    const SurfaceHit hit{hits.mesh[lane], hits.triangle[lane], hits.u[lane], hits.v[lane]};
    const float cross_section = maps[lane]->cross_section(hits.distance[lane]);
    const Vec3 direction = texel_rays[lane].direction;
    out = surface_texel(evaluate_surface(scene.scene(), hit, direction, std::sqrt(cross_section)), texel_rays[lane],
                        cross_section);
  }
}

void ReflectiveShadowMaps::render(const RayScene& scene, const TexelSampling& sampling,
                                  std::vector<SurfaceTexel>& texels) const {
  texels.resize(texel_count());
  const std::size_t packets = (std::size_t(texel_count()) + kPacketRays - 1) / kPacketRays;
  parallel_for(packets, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t packet = begin; packet < end; ++packet) {
      trace_packet(scene, sampling, static_cast<std::uint32_t>(packet * kPacketRays), texels);
    }
  });
}

}  // namespace luciole
