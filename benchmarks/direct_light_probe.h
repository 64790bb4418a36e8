// SPDX-License-Identifier: Apache-2.0
// Direct light of lamps and emissive triangles, one choice of a light at a time, with what variance_parts_benchmark
// wants to know of it: as PathBatch makes it, but with two places on the chosen light, and what would arrive
// unoccluded.
#pragma once
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "benchmarks/learned_visibility.h"
#include "benchmarks/stage.h"
#include "offline/light_sample/light_point.h"
#include "offline/light_sample/make_light_sampler.h"
#include "offline/path/bsdf.h"
#include "offline/path/path_batch.h"
#include "offline/path/probe_paths.h"

namespace luciole {

// Edge of a cube in which visibility is shared, of the scene's diagonal; neighbouring lights that share it.
inline constexpr float kLearnedCells = 64;
inline constexpr std::uint32_t kLearnedLights = 32;

// Direct light of lamps and emissive triangles at one surface point, once.
struct Sample {
  Vec3 first, second;  // the chosen light's, for two places on it: what a shadow ray brings, weighted
  Vec3 correction;     // of its colour
  Vec3 unoccluded;     // mean of both, were nothing in the way
  std::uint32_t chosen = kNoLight;
  Receiver receiver{};
  Vec3 bsdf;  // what the ray that the BSDF samples brings
};

class DirectLight {
 public:
  //   by_area    points on triangles uniformly over their area only
  //   corrected  colours are set right
  DirectLight(const Stage& stage, const RayScene& rays, const PathSettings& settings, bool by_area, bool corrected)
      : rays_(rays),
        by_area_(by_area),
        corrected_(corrected),
        lights_(*stage.scene),
        camera_(stage.camera, settings),
        settings_(settings),
        receivers_(probe_receivers(rays, camera_, settings)),
        sampler_(make_light_sampler({*stage.scene, lights_, settings_, receivers_, rays.bounds().diagonal()})),
        colour_share_(colour_share(rays, lights_, *sampler_, receivers_)) {}

  // Replaces the choice by one that has learned from one shadow ray of each pixel in passes first ... end - 1.
  void learn_visibility(const std::vector<std::uint32_t>& pixels, std::uint32_t first, std::uint32_t end) {
    CullingParameters parameters;
    parameters.radiance_floor = sampler_->error_bound() * 2 * std::numbers::pi_v<float> / settings_.exposure;
    parameters.exposure = settings_.exposure, parameters.scene_diagonal = rays_.bounds().diagonal();
    auto learned = std::make_unique<LearnedVisibilitySampler>(
        lights_, settings_, parameters, parameters.scene_diagonal / kLearnedCells, kLearnedLights);
    LearnedVisibilitySampler& learns = *learned;
    sampler_ = std::move(learned);
    for (std::uint32_t pass = first; pass < end; ++pass) {
      sampler_->begin_pass(pass);
      for (const std::uint32_t pixel : pixels) {
        const Sample found = sample(pixel, pass % 4, pass);
        if (found.chosen != kNoLight && !is_black(found.unoccluded)) {
          learns.learn(found.receiver, found.chosen, !is_black(found.first));
        }
      }
    }
  }

  // Calls use(pixel's place in the list, place in the pixel, sample) for new ranges in each pass.
  template <class Use>
  void measure(const std::vector<std::uint32_t>& pixels, std::uint32_t places, std::uint32_t passes, const Use& use) {
    for (std::uint32_t pass = 0; pass < passes; ++pass) {
      sampler_->begin_pass(pass);
      parallel_for(pixels.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          for (std::uint32_t place = 0; place < places; ++place) use(i, place, sample(pixels[i], place, pass));
        }
      });
    }
  }

 private:
  // A ray from the camera, the same in all passes; then one choice of a light.
  Sample sample(std::uint32_t pixel, std::uint32_t place, std::uint32_t pass) const {
    SampleSequence of_camera(1, pixel, place), numbers(2 + pass, pixel, place);
    const Vec2 on_film = of_camera.pair(), on_lens = of_camera.pair();
    const CameraRay ray = camera_.ray(pixel % settings_.width, pixel / settings_.width, on_film, on_lens);
    const SurfaceHit hit = trace(ray.origin, ray.direction);
    if (hit.mesh == kNoHit) return {};
    const SurfacePoint point = evaluate_surface(rays_.scene(), hit, ray.direction, 0);
    const Bsdf bsdf(point, -ray.direction);
    const Receiver receiver = receiver_of(point, -ray.direction);
    Candidates candidates;
    ChoiceMemory memory;
    sampler_->share_candidates(&receiver, 1, candidates);
    const f32::RandomWords choice = numbers.pair_of_words();
    const ChosenLight chosen = sampler_->choose(receiver, candidates, choice.first * 0x1p-32, memory);
    Sample sample;
    sample.receiver = receiver, sample.chosen = chosen.light;
    if (chosen.light != kNoLight) {
      if (corrected_) sample.correction = colour_correction(point, chosen, colour_share_);
      for (Vec3* arrives : {&sample.first, &sample.second}) {
        const auto [unoccluded, visible] = connect(point, bsdf, receiver, chosen, memory, numbers.pair());
        sample.unoccluded += unoccluded * 0.5f;
        *arrives = visible ? unoccluded : Vec3(0, 0, 0);
      }
    }
    const Vec2 direction = numbers.pair();
    const BsdfSample next = bsdf.sample(direction, numbers.pair().x);
    if (next.pdf > 0) sample.bsdf = met(point, next, receiver, memory);
    return sample;
  }

  SurfaceHit trace(Vec3 origin, Vec3 direction) const {
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
    packet.set(0, origin, direction, 0, 1e30f);
    const HitPacket hits = rays_.intersect(packet, Coherence::incoherent);
    return {hits.mesh[0], hits.triangle[0], hits.u[0], hits.v[0]};
  }

  struct Connection {
    Vec3 unoccluded;
    bool visible = false;
  };
  // As PathBatch::ask_finite_light.
  Connection connect(const SurfacePoint& point, const Bsdf& bsdf, const Receiver& receiver, const ChosenLight& chosen,
                     const ChoiceMemory& memory, Vec2 place) const {
    const LightRecord& record = lights_.records()[chosen.light];
    const LightPoint light = by_area_ && record.lamp == 0
                                 ? point_by_area(record, point.position, place)
                                 : sample_light_point(rays_.scene(), record, point.position, place);
    const float acceptance = light.pdf > 0 ? sampler_->acceptance(chosen.light, light.place) : 0;
    if (!(acceptance > 0)) return {};
    float weight = 1;
    if (record.lamp == 0) {
      const float pdf = light.pdf * sampler_->assumed_pmf(chosen.light, receiver, memory, light.place, 0);
      weight = pdf / (pdf + bsdf.pdf(light.direction));
    }
    const Vec3 arriving =
        bsdf.evaluate(light.direction) * light.radiance * (weight / (chosen.pmf * acceptance * light.pdf));
    if (is_black(arriving)) return {};
    const Vec3 from = rays_.offset_from_surface(point.position, point.geometric_normal);
    const Vec3 to = record.lamp > 0 ? light.position : rays_.offset_from_surface(light.position, light.normal);
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
    packet.set(0, from, to - from, 0, 1);
    return {arriving, (rays_.occluded(packet, Coherence::incoherent) & 1u) == 0};
  }

  LightPoint point_by_area(const LightRecord& record, Vec3 receiver, Vec2 place) const {
    LightPoint light = uniform_light_point(rays_.scene(), record, receiver, place);
    light.pdf = density_by_area(record, light, receiver);
    return light;
  }
  // [1/sr]
  float density_by_area(const LightRecord& record, const LightPoint& light, Vec3 receiver) const {
    const Mesh& mesh = rays_.scene().meshes[record.mesh];
    const std::uint32_t* corner = &mesh.indices[std::size_t(record.triangle) * 3];
    const Vec3 a = mesh.positions[corner[0]];
    const float area = 0.5f * length(cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a));
    const Vec3 apart = light.position - receiver;
    const float cosine = -dot(light.normal, light.direction);
    return cosine > 0 ? dot(apart, apart) / (cosine * area) : 0.0f;
  }

  // As PathBatch::add_emission.
  Vec3 met(const SurfacePoint& point, const BsdfSample& next, const Receiver& receiver,
           const ChoiceMemory& memory) const {
    const SurfaceHit hit = trace(rays_.offset_from_surface(point.position, point.geometric_normal), next.direction);
    if (hit.mesh == kNoHit) return {};
    const std::uint32_t light = lights_.light_of(hit.mesh, hit.triangle);
    if (light == kNoLight) return {};
    const SurfacePoint end = evaluate_surface(rays_.scene(), hit, next.direction, 0);
    LightPoint seen =
        light_point_hit(rays_.scene(), lights_.records()[light], point.position, next.direction, end.position);
    if (by_area_ && seen.pdf > 0) seen.pdf = density_by_area(lights_.records()[light], seen, point.position);
    float weight = 1;
    if (seen.pdf > 0) {
      weight = next.pdf / (next.pdf + seen.pdf * sampler_->assumed_pmf(light, receiver, memory, seen.place, 0));
    }
    return next.weight * end.emission * weight;
  }

  const RayScene& rays_;
  bool by_area_, corrected_;
  LightSet lights_;
  CameraRays camera_;
  const PathSettings& settings_;
  std::vector<Receiver> receivers_;
  std::unique_ptr<LightSampler> sampler_;
  float colour_share_;
};

}  // namespace luciole
