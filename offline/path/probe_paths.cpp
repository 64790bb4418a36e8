// SPDX-License-Identifier: Apache-2.0
#include "offline/path/probe_paths.h"

#include <algorithm>

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

float visible_share(const RayScene& rays, const LightSet& lights, LightSampler& sampler,
                    const std::vector<Receiver>& receivers) {
  constexpr std::uint64_t kProbePass = ~std::uint64_t(2);  // ranges that are not in the picture
  if (receivers.empty() || lights.size() == 0) return 0;
  sampler.begin_pass(kProbePass);
  Candidates candidates;
  ChoiceMemory memory;
  std::uint32_t chosen_lights = 0, visible = 0;
  for (std::uint32_t i = 0; i < receivers.size(); ++i) {
    const Receiver& receiver = receivers[i];
    SampleSequence numbers(kProbeSeed, 1, i);
    sampler.share_candidates(&receiver, 1, candidates);
    const ChosenLight chosen = sampler.choose(receiver, candidates, numbers.pair_of_words().first * 0x1p-32, memory);
    if (chosen.light == kNoLight) continue;
    ++chosen_lights;
    const Vec3 position(receiver.position[0], receiver.position[1], receiver.position[2]);
    const Vec3 normal(receiver.geometric_normal[0], receiver.geometric_normal[1], receiver.geometric_normal[2]);
    const LightPoint light = sample_light_point(rays.scene(), lights.records()[chosen.light], position, numbers.pair());
    if (!(light.pdf > 0) || !(sampler.acceptance(chosen.light, light.place) > 0)) continue;
    const Vec3 from = rays.offset_from_surface(position, normal);
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
    packet.set(0, from, rays.offset_from_surface(light.position, light.normal) - from, 0, 1);
    if ((rays.occluded(packet, Coherence::incoherent) & 1u) == 0) ++visible;
  }
  return chosen_lights == 0 ? 0.0f : static_cast<float>(visible) / static_cast<float>(chosen_lights);
}

float distance_at_centre(const RayScene& rays, const Camera& camera) {
  RayPacket packet;
  for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
  packet.set(0, camera.eye, camera.forward, 0, 1e30f);
  const HitPacket hits = rays.intersect(packet, Coherence::coherent);
  return hits.mesh[0] == kNoHit ? std::max(rays.bounds().diagonal(), 1e-3f) : hits.distance[0];
}

}  // namespace luciole
