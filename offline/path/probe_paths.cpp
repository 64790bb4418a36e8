// SPDX-License-Identifier: Apache-2.0
#include "offline/path/probe_paths.h"

#include <algorithm>

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

float distance_at_centre(const RayScene& rays, const Camera& camera) {
  RayPacket packet;
  for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
  packet.set(0, camera.eye, camera.forward, 0, 1e30f);
  const HitPacket hits = rays.intersect(packet, Coherence::coherent);
  return hits.mesh[0] == kNoHit ? std::max(rays.bounds().diagonal(), 1e-3f) : hits.distance[0];
}

}  // namespace luciole
