// SPDX-License-Identifier: Apache-2.0
#include "offline/path/path_batch.h"

#include <algorithm>
#include <cmath>

#include "base/fold_seed.h"
#include "offline/light_sample/light_point.h"
#include "scene/emissive_triangles.h"
#include "scene/sky.h"
#include "scene/surface.h"

namespace luciole {
namespace {

constexpr float kFar = 1e30f;
constexpr float kFinestLevel = -20;          // of textures' detail
constexpr std::uint32_t kFirstRoulette = 3;  // scatterings before paths are ended at random

Vec3 point_of(const float v[3]) { return {v[0], v[1], v[2]}; }

// What paths ask of a surface, of one lane.
SurfacePoint point_of(const SurfaceAnswers& answers, int lane) {
  const auto vector = [lane](const float v[3][kSurfaceLanes]) { return Vec3(v[0][lane], v[1][lane], v[2][lane]); };
  SurfacePoint point{};
  point.position = vector(answers.position);
  point.geometric_normal = vector(answers.geometric_normal), point.shading_normal = vector(answers.shading_normal);
  point.diffuse_albedo = vector(answers.diffuse_albedo), point.f0 = vector(answers.f0);
  point.f90 = answers.f90[lane], point.ggx_alpha = answers.ggx_alpha[lane];
  point.emission = vector(answers.emission);
  return point;
}

void copy(Vec3 from, float to[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

// The balance heuristic: weight of a technique beside another one.   [Veach and Guibas 1995]
float balance(float own, float other) { return own / (own + other); }

// Surface points that share their candidates. Sixteen along the curve lie close together.
constexpr std::uint32_t kGroup = 16;

// Unlit materials show a colour to the eye, and light nothing.
bool is_unlit(const Scene& scene, const SurfaceHit& hit) {
  return scene.materials[scene.meshes[hit.mesh].material].unlit;
}

// Pixels of a tile in the order of 4x4 blocks: one packet each.
constexpr std::uint32_t kBlocks = PathBatch::kSide / 4;
std::uint32_t block_x(std::uint32_t i) { return (i / 16 % kBlocks) * 4 + i % 4; }
std::uint32_t block_y(std::uint32_t i) { return (i / 16 / kBlocks) * 4 + i / 4 % 4; }

}  // namespace

Receiver receiver_of(const SurfacePoint& point, Vec3 to_eye) {
  Receiver receiver{};
  copy(point.position, receiver.position);
  copy(point.shading_normal, receiver.shading_normal);
  copy(point.geometric_normal, receiver.geometric_normal);
  copy(to_eye, receiver.to_eye);
  receiver.diffuse = channel_mean(point.diffuse_albedo), receiver.f0 = channel_mean(point.f0), receiver.f90 = point.f90;
  receiver.ggx_alpha = point.ggx_alpha;
  return receiver;
}

Vec3 colour_correction(const SurfacePoint& point, const ChosenLight& chosen, float colour_share) {
  const Vec3 reflectance = point.diffuse_albedo + point.f0;
  return reflectance * chosen.colour_apart * (colour_share / std::max(channel_mean(reflectance), 1e-20f));
}

void PathBatch::render(std::uint32_t left, std::uint32_t top, FilmSample* samples) {
  begin(left, top);
  statistics_.paths += active_.size();
  const std::vector<std::uint32_t> all = active_;
  for (std::uint32_t scattering = 0; scattering <= context_.settings.bounces && !active_.empty(); ++scattering) {
    trace_all(scattering);
    scatter_all(scattering);
    trace_shadow_rays();
  }
  for (const std::uint32_t index : all) {
    const Path& path = paths_[index];
    samples[path.pixel] = {path.radiance, path.albedo, path.normal};
  }
}

void PathBatch::begin(std::uint32_t left, std::uint32_t top) {
  active_.clear();
  const PathSettings& settings = context_.settings;
  const std::uint32_t seed = folded(settings.seed);
  for (std::uint32_t i = 0; i < kPaths; ++i) {
    const std::uint32_t x = left + block_x(i), y = top + block_y(i);
    if (x >= settings.width || y >= settings.height) continue;
    Path& path = paths_[i];
    path.pixel = y * settings.width + x;
    path.numbers = SampleSequence(seed, path.pixel, context_.sample);
    const Vec2 place = path.numbers.pair(), lens = path.numbers.pair();
    const CameraRay ray = context_.camera.ray(x, y, place, lens);
    path.origin = ray.origin, path.direction = ray.direction, path.film_offset = ray.offset;
    path.throughput = {1, 1, 1};
    path.radiance = path.albedo = path.normal = {0, 0, 0};
    path.bsdf_pdf = 0;
    active_.push_back(i);
  }
}

void PathBatch::trace_all(std::uint32_t scattering) {
  const Coherence coherence = scattering == 0 ? Coherence::coherent : Coherence::incoherent;
  arrivals_.clear();
  for (std::size_t first = 0; first < active_.size(); first += kPacketRays) {
    const auto count = static_cast<int>(std::min<std::size_t>(kPacketRays, active_.size() - first));
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) {
      if (lane >= count) {
        packet.skip(lane);
        continue;
      }
      Path& path = paths_[active_[first + static_cast<std::size_t>(lane)]];
      packet.set(lane, path.origin, path.direction, 0, kFar, path.numbers.bits());
    }
    statistics_.rays += static_cast<std::uint64_t>(count);
    const HitPacket hits = context_.rays.intersect(packet, coherence);
    arrive_all(&active_[first], count, hits, scattering);
  }
}

void PathBatch::arrive_all(const std::uint32_t* paths, int count, const HitPacket& hits, std::uint32_t scattering) {
  SurfaceAnswers answers;
  const bool together = count == kPacketRays && std::all_of(hits.mesh, hits.mesh + count, [&](std::uint32_t mesh) {
                          return mesh == hits.mesh[0] && mesh != kNoHit;
                        });
  if (together) evaluate_together(paths, hits, scattering, answers);
  for (int lane = 0; lane < count; ++lane) {
    Path& path = paths_[paths[lane]];
    if (hits.mesh[lane] == kNoHit) {
      add_sky(path);
      continue;
    }
    const SurfaceHit hit{hits.mesh[lane], hits.triangle[lane], hits.u[lane], hits.v[lane]};
    const float distance = hits.distance[lane];
    const SurfacePoint point =
        together ? point_of(answers, lane)
                 : evaluate_surface(context_.rays.scene(), hit, path.direction, cone_width(path, distance, scattering));
    arrive(paths[lane], hit, distance, point, scattering);
  }
}

// Sixteen surface points of one mesh: most of what the camera's packets meet.
void PathBatch::evaluate_together(const std::uint32_t* paths, const HitPacket& hits, std::uint32_t scattering,
                                  SurfaceAnswers& answers) const {
  SurfaceQueries queries;
  for (int lane = 0; lane < kPacketRays; ++lane) {
    const Path& path = paths_[paths[lane]];
    queries.triangle[lane] = hits.triangle[lane], queries.u[lane] = hits.u[lane], queries.v[lane] = hits.v[lane];
    queries.ray_direction[0][lane] = path.direction.x, queries.ray_direction[1][lane] = path.direction.y;
    queries.ray_direction[2][lane] = path.direction.z;
    queries.cone_width[lane] = cone_width(path, hits.distance[lane], scattering);
  }
  const SurfaceMesh& mesh = context_.surfaces.mesh(hits.mesh[0]);
  LUCIOLE_FOR_ISA(context_.settings.isa, evaluate_surfaces(mesh, queries, answers));
}

// Textures at the camera's footprint where the eye sees them; behind a reflection at their finest, as shadow rays see
// emitters.
float PathBatch::cone_width(const Path& path, float distance, std::uint32_t scattering) const {
  return scattering == 0 ? context_.camera.pixel_size() * context_.camera.depth(path.direction, distance) : 0;
}

void PathBatch::arrive(std::uint32_t index, const SurfaceHit& hit, float distance, const SurfacePoint& point,
                       std::uint32_t scattering) {
  Path& path = paths_[index];
  if (scattering == 0) {
    path.albedo = point.diffuse_albedo + point.f0;
    path.normal = point.shading_normal;
  }
  if (!is_black(point.emission) && (path.bsdf_pdf == 0 || !is_unlit(context_.rays.scene(), hit)))
    add_emission(path, hit, distance, point);
  if (scattering < context_.settings.bounces) arrivals_.push_back({place_of(point.position), index, point});
}

std::uint32_t PathBatch::place_of(Vec3 position) const {
  const Bounds& box = context_.rays.bounds();
  const float size = std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z, 1e-20f});
  const Vec3 cell = (position - box.low) * (1023 / size);
  const auto whole = [](float x) { return static_cast<std::uint32_t>(std::clamp(x, 0.0f, 1023.0f)); };
  return f32::morton_code(whole(cell.x), whole(cell.y), whole(cell.z));
}

// Clusters the surface points: neighbours walk through the tree of lights together, and what they send out next starts
// close together as well.
void PathBatch::scatter_all(std::uint32_t scattering) {
  order_.clear();
  for (std::uint32_t i = 0; i < arrivals_.size(); ++i) order_.emplace_back(arrivals_[i].place, i);
  // What the camera sees comes in packets of neighbours already.
  if (scattering > 0) std::sort(order_.begin(), order_.end());
  active_.clear();
  std::uint32_t group[kGroup];
  for (std::size_t first = 0; first < order_.size(); first += kGroup) {
    const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(kGroup, order_.size() - first));
    for (std::uint32_t i = 0; i < count; ++i) group[i] = order_[first + i].second;
    scatter_group(group, count, scattering);
  }
}

void PathBatch::scatter_group(const std::uint32_t* arrivals, std::uint32_t count, std::uint32_t scattering) {
  Receiver receivers[kGroup];
  for (std::uint32_t i = 0; i < count; ++i) {
    const Arrival& arrival = arrivals_[arrivals[i]];
    Path& path = paths_[arrival.path];
    path.from = receivers[i] = receiver_of(arrival.point, -path.direction);
  }
  context_.sampler.share_candidates(receivers, count, candidates_);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Arrival& arrival = arrivals_[arrivals[i]];
    const bool last = scattering + 1 == context_.settings.bounces;
    const Bsdf bsdf(arrival.point, -paths_[arrival.path].direction, last ? last_diffuse_share() : 1.0f);
    if (scatter(arrival, bsdf, scattering)) active_.push_back(arrival.path);
  }
}

// A path's last ray can only meet emitters, which shadow rays find better, unless a lobe is narrow: most of the diffuse
// ones are saved, and multiple importance sampling knows. A constant sky is found by them alone.
float PathBatch::last_diffuse_share() const {
  constexpr float kShare = 0.25f;
  const Environment& sky = context_.rays.scene().environment;
  return sky.pixels.empty() && !is_black(sky.radiance) ? 1.0f : kShare;
}

bool PathBatch::scatter(const Arrival& arrival, const Bsdf& bsdf, std::uint32_t scattering) {
  Path& path = paths_[arrival.path];
  const SurfacePoint& point = arrival.point;
  if (context_.lights.size() > 0) ask_finite_light(arrival, bsdf);
  if (!context_.infinite.empty()) ask_infinite_light(arrival, bsdf);
  const Vec2 place = path.numbers.pair(), lobe_and_roulette = path.numbers.pair();
  const BsdfSample next = bsdf.sample(place, lobe_and_roulette.x);
  if (!(next.pdf > 0)) return false;
  path.throughput = path.throughput * next.weight;
  if (scattering + 1 >= kFirstRoulette) {
    const float survival = std::min(std::max({path.throughput.x, path.throughput.y, path.throughput.z}), 0.95f);
    if (!(lobe_and_roulette.y < survival)) return false;
    path.throughput = path.throughput / survival;
  }
  path.origin = context_.rays.offset_from_surface(point.position, point.geometric_normal);
  path.direction = next.direction;
  path.bsdf_pdf = next.pdf;
  return true;
}

void PathBatch::add_sky(Path& path) const {
  const Environment& sky = context_.rays.scene().environment;
  const Vec3 radiance = sky_radiance(sky, path.direction);
  if (is_black(radiance)) return;
  const float weight = path.bsdf_pdf > 0 ? balance(path.bsdf_pdf, context_.infinite.sky_pdf(path.direction)) : 1.0f;
  path.radiance += path.throughput * radiance * weight;
}

void PathBatch::add_emission(Path& path, const SurfaceHit& hit, float distance, const SurfacePoint& point) const {
  const std::uint32_t light = context_.lights.light_of(hit.mesh, hit.triangle);
  Vec3 radiance = point.emission;
  float weight = 1;
  if (light != kNoLight && path.bsdf_pdf > 0) {
    const LightPoint seen = light_point_hit(context_.rays.scene(), context_.lights.records()[light],
                                            point_of(path.from.position), path.direction, point.position);
    if (seen.pdf > 0) {
      const float pmf = context_.sampler.assumed_pmf(light, path.from, path.choice, seen.place, path.numbers.bits());
      weight = balance(path.bsdf_pdf, pmf * seen.pdf);
    }
  } else if (light != kNoLight) {
    radiance = emission_at(context_.rays.scene(), hit, kFinestLevel);  // as projected points see it
    weight = context_.visible.weight_of_camera_ray(light, {path.origin, path.direction, path.film_offset}, distance);
  }
  path.radiance += path.throughput * radiance * weight;
}

void PathBatch::ask_finite_light(const Arrival& arrival, const Bsdf& bsdf) {
  Path& path = paths_[arrival.path];
  const SurfacePoint& point = arrival.point;
  const f32::RandomWords choice = path.numbers.pair_of_words();
  const Vec2 place = path.numbers.pair();
  const ChosenLight chosen = context_.sampler.choose(path.from, candidates_, choice.first * 0x1p-32, path.choice);
  ++statistics_.light_choices, statistics_.candidates += chosen.weighed;
  if (chosen.light == kNoLight) return;
  path.radiance += path.throughput * colour_correction(point, chosen, context_.colour_share);
  const LightRecord& record = context_.lights.records()[chosen.light];
  const LightPoint light = sample_light_point(context_.rays.scene(), record, point.position, place);
  if (!(light.pdf > 0) || is_black(light.radiance)) return;
  const float acceptance = context_.sampler.acceptance(chosen.light, light.place);
  if (!(acceptance > 0)) return;
  const Vec3 reflected = bsdf.evaluate(light.direction);
  if (is_black(reflected)) return;
  float weight = 1;
  if (record.lamp == 0) {
    const float pmf = context_.sampler.assumed_pmf(chosen.light, path.from, path.choice, light.place, choice.second);
    weight = balance(pmf * light.pdf, bsdf.pdf(light.direction));
  }
  const float density = chosen.pmf * acceptance * light.pdf;
  const Vec3 end = record.lamp > 0 ? light.position : context_.rays.offset_from_surface(light.position, light.normal);
  shadow_rays_.push_back({context_.rays.offset_from_surface(point.position, point.geometric_normal), end,
                          path.throughput * reflected * light.radiance * (weight / density), arrival.path,
                          path.numbers.bits()});
}

void PathBatch::ask_infinite_light(const Arrival& arrival, const Bsdf& bsdf) {
  Path& path = paths_[arrival.path];
  const SurfacePoint& point = arrival.point;
  const f32::RandomWords choice = path.numbers.pair_of_words();
  const InfiniteLightSample light = context_.infinite.sample(choice.first * 0x1p-32, path.numbers.pair());
  if (!(light.pdf > 0)) return;
  const Vec3 reflected = bsdf.evaluate(light.direction);
  if (is_black(reflected) || is_black(light.radiance)) return;
  const float weight = light.is_sun ? 1.0f : balance(light.pdf, bsdf.pdf(light.direction));
  const Vec3 origin = context_.rays.offset_from_surface(point.position, point.geometric_normal);
  const float beyond = 2 * context_.rays.bounds().diagonal() + length(origin - context_.rays.bounds().centre());
  shadow_rays_.push_back({origin, origin + light.direction * beyond,
                          path.throughput * reflected * light.radiance * (weight / light.pdf), arrival.path,
                          path.numbers.bits()});
}

void PathBatch::trace_shadow_rays() {
  for (std::size_t first = 0; first < shadow_rays_.size(); first += kPacketRays) {
    const auto count = static_cast<int>(std::min<std::size_t>(kPacketRays, shadow_rays_.size() - first));
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) {
      if (lane >= count) {
        packet.skip(lane);
        continue;
      }
      const ShadowRay& ray = shadow_rays_[first + static_cast<std::size_t>(lane)];
      packet.set(lane, ray.origin, ray.towards - ray.origin, 0, 1, ray.random);
    }
    const std::uint32_t blocked = context_.rays.occluded(packet, Coherence::incoherent);
    for (int lane = 0; lane < count; ++lane) {
      const ShadowRay& ray = shadow_rays_[first + static_cast<std::size_t>(lane)];
      if ((blocked >> lane & 1u) == 0) paths_[ray.path].radiance += ray.light;
    }
  }
  statistics_.rays += shadow_rays_.size();
  shadow_rays_.clear();
}

}  // namespace luciole
