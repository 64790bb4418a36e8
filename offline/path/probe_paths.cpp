// SPDX-License-Identifier: Apache-2.0
#include "offline/path/probe_paths.h"

#include <algorithm>

#include "equations/cpp/float.h"
#include "offline/light_sample/light_point.h"
#include "offline/path/bsdf.h"
#include "offline/path/path_batch.h"
#include "offline/path/sample_sequence.h"

namespace luciole {
namespace {

constexpr std::uint32_t kProbes = 512;
constexpr std::uint32_t kProbeSeed = 0x70726f62;

struct Probe {
  Vec3 origin, direction;
  SampleSequence numbers;
};

// Traces the probes; each becomes a receiver and goes on by its BSDF, or ends.
void arrive(const RayScene& rays, std::vector<Probe>& probes, std::vector<Receiver>& receivers) {
  std::vector<Probe> next;
  for (std::size_t first = 0; first < probes.size(); first += kPacketRays) {
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) {
      const std::size_t i = first + static_cast<std::size_t>(lane);
      if (i < probes.size()) {
        packet.set(lane, probes[i].origin, probes[i].direction, 0, 1e30f);
      } else {
        packet.skip(lane);
      }
    }
    const HitPacket hits = rays.intersect(packet, Coherence::incoherent);
    for (int lane = 0; lane < kPacketRays; ++lane) {
      if (hits.mesh[lane] == kNoHit) continue;
      Probe& probe = probes[first + static_cast<std::size_t>(lane)];
      const SurfaceHit hit{hits.mesh[lane], hits.triangle[lane], hits.u[lane], hits.v[lane]};
      const SurfacePoint point = evaluate_surface(rays.scene(), hit, probe.direction, 0);
      receivers.push_back(receiver_of(point, -probe.direction));
      const Vec2 place = probe.numbers.pair(), lobe = probe.numbers.pair();
      const BsdfSample sample = Bsdf(point, -probe.direction).sample(place, lobe.x);
      if (!(sample.pdf > 0)) continue;
      next.push_back(
          {rays.offset_from_surface(point.position, point.geometric_normal), sample.direction, probe.numbers});
    }
  }
  probes.swap(next);
}

constexpr std::uint32_t kColourPasses = 16;
constexpr std::size_t kColourProbes = 64;  // the exhaustive choice is slow

// One choice of a light at a probe: what arrives by it, and the correction of its colour.
struct ColourProbe {
  Vec3 light{0, 0, 0}, apart{0, 0, 0};
};

ColourProbe probe_colour(const RayScene& rays, const LightSet& lights, const LightSampler& sampler,
                         const Receiver& receiver, SampleSequence numbers) {
  const auto vector = [](const float v[3]) { return Vec3(v[0], v[1], v[2]); };
  Candidates candidates;
  ChoiceMemory memory;
  sampler.share_candidates(&receiver, 1, candidates);
  const ChosenLight chosen = sampler.choose(receiver, candidates, numbers.pair_of_words().first * 0x1p-32, memory);
  ColourProbe probe{{0, 0, 0}, chosen.colour_apart};
  if (chosen.light == kNoLight) return probe;
  const Vec3 position = vector(receiver.position), normal = vector(receiver.geometric_normal);
  const LightPoint light = sample_light_point(rays.scene(), lights.records()[chosen.light], position, numbers.pair());
  const float acceptance = light.pdf > 0 ? sampler.acceptance(chosen.light, light.place) : 0;
  if (!(acceptance > 0) || !(dot(light.direction, normal) > 0)) return probe;
  const Vec3 from = rays.offset_from_surface(position, normal);
  RayPacket packet;
  for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
  packet.set(0, from, rays.offset_from_surface(light.position, light.normal) - from, 0, 1);
  if ((rays.occluded(packet, Coherence::incoherent) & 1u) != 0) return probe;
  const f32::SurfaceBrdf brdf{{receiver.diffuse, receiver.diffuse, receiver.diffuse},
                              {receiver.f0, receiver.f0, receiver.f0},
                              receiver.f90,
                              receiver.ggx_alpha};
  const f32::Reflection reflected = f32::reflection(
      f32::fix_direction(brdf, vector(receiver.shading_normal), vector(receiver.to_eye)), light.direction);
  probe.light = light.radiance *
                ((receiver.diffuse * reflected.diffuse + reflected.specular.x) / (chosen.pmf * acceptance * light.pdf));
  return probe;
}

// Least relMSE of light + share * apart, over probes whose means tell what their errors are relative to.
float best_share(const std::vector<ColourProbe>& probes) {
  std::vector<double> means(probes.size() / kColourPasses);
  double brightness = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    for (std::uint32_t k = 0; k < kColourPasses; ++k) {
      means[i] += double(channel_mean(probes[i * kColourPasses + k].light)) / kColourPasses;
    }
    brightness += means[i] / static_cast<double>(means.size());
  }
  double together = 0, squares = 0;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto& [light, apart] = probes[i];
    const double mean = means[i / kColourPasses], scale = mean * mean + 0.01 * brightness * brightness;
    if (!(scale > 0)) continue;
    together += double(dot(light, apart)) / scale, squares += double(dot(apart, apart)) / scale;
  }
  return squares > 0 ? static_cast<float>(std::clamp(-together / squares, 0.0, 1.0)) : 0.0f;
}

}  // namespace

std::vector<Receiver> probe_receivers(const RayScene& rays, const CameraRays& camera, const PathSettings& settings) {
  std::vector<Probe> probes;
  for (std::uint32_t i = 0; i < kProbes; ++i) {
    SampleSequence numbers(kProbeSeed, 0, i);
    const Vec2 pixel = numbers.pair(), place = numbers.pair(), lens = numbers.pair();
    const auto x = static_cast<std::uint32_t>(pixel.x * static_cast<float>(settings.width));
    const auto y = static_cast<std::uint32_t>(pixel.y * static_cast<float>(settings.height));
    const CameraRay ray = camera.ray(x, y, place, lens);
    probes.push_back({ray.origin, ray.direction, numbers});
  }
  std::vector<Receiver> receivers;
  arrive(rays, probes, receivers);
  if (settings.bounces > 1) arrive(rays, probes, receivers);
  return receivers;
}

float colour_share(const RayScene& rays, const LightSet& lights, LightSampler& sampler,
                   const std::vector<Receiver>& receivers) {
  constexpr std::uint64_t kProbePass = ~std::uint64_t(2);  // ranges that are not in the picture; from there backwards
  const std::size_t count = std::min(receivers.size(), kColourProbes);
  std::vector<ColourProbe> probes(count * kColourPasses);
  for (std::uint32_t pass = 0; pass < kColourPasses && lights.size() > 0; ++pass) {
    sampler.begin_pass(kProbePass - pass);
    for (std::size_t i = 0; i < count; ++i) {
      const SampleSequence numbers(kProbeSeed, 1 + pass, i);
      probes[i * kColourPasses + pass] =
          probe_colour(rays, lights, sampler, receivers[i * receivers.size() / count], numbers);
    }
  }
  return best_share(probes);
}

float distance_at_centre(const RayScene& rays, const Camera& camera) {
  RayPacket packet;
  for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
  packet.set(0, camera.eye, camera.forward, 0, 1e30f);
  const HitPacket hits = rays.intersect(packet, Coherence::coherent);
  return hits.mesh[0] == kNoHit ? std::max(rays.bounds().diagonal(), 1e-3f) : hits.distance[0];
}

}  // namespace luciole
