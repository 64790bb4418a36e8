// SPDX-License-Identifier: Apache-2.0
#include "offline/path/visible_emitters.h"

#include <algorithm>
#include <cmath>

#include "base/fold_seed.h"
#include "base/parallel.h"
#include "offline/light_sample/light_point.h"
#include "offline/path/sample_sequence.h"

namespace luciole {
namespace {

constexpr float kPointsPerPixel = 8;  // that an emitter covers, as seen from its front
constexpr float kMostPoints = 64;     // of one emitter: larger ones are met by many camera rays
constexpr std::size_t kChunk = 4096;  // lights per unit of work

}  // namespace

VisibleEmitters::VisibleEmitters(const RayScene& rays, const LightSet& lights, const CameraRays& camera,
                                 const PathSettings& settings)
    : rays_(rays), lights_(lights), camera_(camera), settings_(settings), points_per_area_(lights.size(), 0.0f) {
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const LightRecord& light = lights.records()[i];
    if (light.lamp == 0) points_per_area_[i] = expected_points(light) / area_of(light);
  }
}

float VisibleEmitters::area_of(const LightRecord& light) const {
  const Mesh& mesh = rays_.scene().meshes[light.mesh];
  const std::uint32_t* corner = &mesh.indices[std::size_t(light.triangle) * 3];
  const Vec3 a = mesh.positions[corner[0]];
  return 0.5f * length(cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a));
}

// None where the centre is outside the film by more than the filter and the light's own size reach; a few too few or
// too many change the error, not the mean.
float VisibleEmitters::expected_points(const LightRecord& light) const {
  const FilmPlace place = camera_.place_of(light.centre(), {0, 0});
  const Vec3 apart = light.centre() - camera_.eye();
  const float distance_sq = dot(apart, apart);
  if (!place.in_front || !(distance_sq > light.radius * light.radius)) return 0;
  const Vec3 direction = apart * (1 / std::sqrt(distance_sq));
  const float cosine = directional_factor(light, -dot(light.axis(), direction));
  const float scale = std::sqrt(camera_.film_per_area(direction, distance_sq, 1));
  const float margin = filter_radius(camera_.filter()) + light.radius * scale;
  const bool on_film = place.pixels.x > -margin && place.pixels.y > -margin &&
                       place.pixels.x < static_cast<float>(settings_.width) + margin &&
                       place.pixels.y < static_cast<float>(settings_.height) + margin;
  if (!on_film || !(cosine > 0)) return 0;
  return std::min(kPointsPerPixel * cosine * scale * scale * area_of(light), kMostPoints);
}

float VisibleEmitters::weight_of_camera_ray(std::uint32_t light, const CameraRay& ray, float distance) const {
  const LightRecord& record = lights_.records()[light];
  const float cosine = directional_factor(record, -dot(record.axis(), ray.direction));
  const float of_ray =
      filter_density(camera_.filter(), ray.offset) * camera_.film_per_area(ray.direction, distance * distance, cosine);
  return of_ray > 0 ? of_ray / (of_ray + points_per_area_[light]) : 1.0f;
}

void VisibleEmitters::project(std::uint32_t light, std::uint64_t pass, std::vector<Projection>& projections) const {
  const LightRecord& record = lights_.records()[light];
  const float expected = points_per_area_[light] * area_of(record);
  const std::uint32_t seed = folded(settings_.seed) + 0x656d6974u;  // not the paths' numbers
  SampleSequence numbers(seed, light, pass);
  const auto whole = static_cast<std::uint32_t>(expected);
  const std::uint32_t count = whole + (numbers.pair().x < expected - static_cast<float>(whole) ? 1 : 0);
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vec2 on_light = numbers.pair(), on_lens = numbers.pair();
    const LightPoint point = uniform_light_point(rays_.scene(), record, camera_.eye(), on_light);
    if (is_black(point.radiance)) continue;
    const FilmPlace place = camera_.place_of(point.position, on_lens);
    if (!place.in_front) continue;
    const Vec3 apart = point.position - place.lens;
    const float distance_sq = dot(apart, apart);
    const Vec3 direction = apart * (1 / std::sqrt(distance_sq));
    const float cosine = directional_factor(record, -dot(record.axis(), direction));
    if (!(cosine > 0)) continue;
    projections.push_back({place.lens, rays_.offset_from_surface(point.position, point.normal), point.radiance,
                           place.pixels, camera_.film_per_area(direction, distance_sq, cosine), light, numbers.bits()});
  }
}

// L h J / (h J + n / A) for every pixel whose filter h the point falls into, J the film's area per emitter's area and
// n / A the points per area.
void VisibleEmitters::splat(const Projection& projection, std::vector<Splat>& splats) const {
  const float radius = filter_radius(camera_.filter());
  const auto first = [radius](float at) { return static_cast<int>(std::ceil(at - radius - 0.5f)); };
  const auto last = [radius](float at) { return static_cast<int>(std::floor(at + radius - 0.5f)); };
  const int bottom = std::min(last(projection.pixels.y), static_cast<int>(settings_.height) - 1);
  const int right = std::min(last(projection.pixels.x), static_cast<int>(settings_.width) - 1);
  for (int y = std::max(first(projection.pixels.y), 0); y <= bottom; ++y) {
    for (int x = std::max(first(projection.pixels.x), 0); x <= right; ++x) {
      const Vec2 offset{projection.pixels.x - (static_cast<float>(x) + 0.5f),
                        projection.pixels.y - (static_cast<float>(y) + 0.5f)};
      const float of_ray = filter_density(camera_.filter(), offset) * projection.film_per_area;
      if (!(of_ray > 0)) continue;
      const auto pixel = static_cast<std::uint32_t>(y) * settings_.width + static_cast<std::uint32_t>(x);
      splats.push_back({pixel, projection.radiance * (of_ray / (of_ray + points_per_area_[projection.light]))});
    }
  }
}

void VisibleEmitters::splat_visible(const std::vector<Projection>& projections, std::vector<Splat>& splats) const {
  for (std::size_t first = 0; first < projections.size(); first += kPacketRays) {
    RayPacket packet;
    for (int lane = 0; lane < kPacketRays; ++lane) {
      const std::size_t i = first + static_cast<std::size_t>(lane);
      if (i < projections.size()) {
        packet.set(lane, projections[i].lens, projections[i].end - projections[i].lens, 0, 1, projections[i].random);
      } else {
        packet.skip(lane);
      }
    }
    const std::uint32_t blocked = rays_.occluded(packet, Coherence::incoherent);
    for (std::size_t i = first; i < std::min(first + kPacketRays, projections.size()); ++i) {
      if ((blocked >> (i - first) & 1u) == 0) splat(projections[i], splats);
    }
  }
}

std::uint64_t VisibleEmitters::add_to(std::uint64_t pass, std::vector<FilmSample>& samples) const {
  const std::size_t chunks = (lights_.size() + kChunk - 1) / kChunk;
  std::vector<std::vector<Splat>> splats(chunks);
  std::vector<std::uint64_t> rays(chunks, 0);
  parallel_for(chunks, 1, [&](std::size_t begin, std::size_t end) {
    std::vector<Projection> projections;
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      projections.clear();
      const std::size_t last = std::min<std::size_t>(lights_.size(), (chunk + 1) * kChunk);
      for (std::size_t light = chunk * kChunk; light < last; ++light) {
        if (points_per_area_[light] > 0) project(static_cast<std::uint32_t>(light), pass, projections);
      }
      splat_visible(projections, splats[chunk]);
      rays[chunk] = projections.size();
    }
  });
  // In the lights' order, so that the sums are the same on any number of threads.
  std::uint64_t all = 0;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    for (const Splat& splat : splats[chunk]) samples[splat.pixel].radiance += splat.radiance;
    all += rays[chunk];
  }
  return all;
}

}  // namespace luciole
