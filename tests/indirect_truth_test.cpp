// SPDX-License-Identifier: Apache-2.0
// The real-time frame's single-bounce light, by another road: rays from the pixel's surface by its BSDF, and at every
// surface along each (virtual lights shine through walls) the primary light's direct light, with its shadow ray. The
// mean over many seeds of the virtual lights, with infinite ranges and points for lights, must be the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "image/estimator_statistics.h"
#include "offline/path/bsdf.h"
#include "offline/path/camera_rays.h"
#include "offline/path/sample_sequence.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/frame.h"
#include "scene/default_lights.h"
#include "scene/punctual_light.h"
#include "scene/recipes/recipes.h"
#include "scene/surface.h"

namespace luciole {
namespace {

constexpr std::uint32_t kWidth = 32, kHeight = 24, kBlock = 8;
constexpr std::uint32_t kSeeds = 256, kBatches = 64, kSamplesPerBatch = 32;
constexpr float kFar = 1e30f;

struct Stage {
  std::shared_ptr<const Scene> scene;
  Camera camera;
  PunctualLight light;
};

Stage stage(const std::string& address) {
  Result<Scene> scene = make_recipe_from_address(address);
  EXPECT_TRUE(scene.has_value());
  const std::vector<std::size_t> lights = strongest_lights(*scene, 1);
  const PunctualLight light = scene->lights.at(lights.at(0));
  scene->lights = {light};
  // Moved a little: in a symmetrical view rays meet edges exactly, and either side is right.
  Camera camera = scene->cameras.at(0);
  camera.eye = camera.eye + camera.right * 0.0137f + camera.up * 0.0093f;
  return {std::make_shared<const Scene>(std::move(*scene)), camera, light};
}

// One ray; false if it meets nothing between nearest and farthest.
bool trace(const RayScene& rays, Vec3 origin, Vec3 direction, float nearest, SurfaceHit& hit, float& distance) {
  RayPacket packet;
  for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
  packet.set(0, origin, direction, nearest, kFar);
  const HitPacket hits = rays.intersect(packet, Coherence::incoherent);
  hit = {hits.mesh[0], hits.triangle[0], hits.u[0], hits.v[0]};
  distance = hits.distance[0];
  return hits.mesh[0] != kNoHit;
}

bool is_open(const RayScene& rays, Vec3 from, Vec3 to) {
  RayPacket packet;
  for (int lane = 0; lane < kPacketRays; ++lane) packet.skip(lane);
  packet.set(0, from, to - from, 0, 1 - 1e-4f);
  return rays.occluded(packet, Coherence::incoherent) == 0;
}

// Radiance that leaves a surface point towards the ray's origin, of the primary light alone.
Vec3 lit_radiance(const RayScene& rays, const PunctualLight& light, const SurfacePoint& point, Vec3 to_eye) {
  const Vec3 apart = light.position - point.position;
  const float distance_sq = dot(apart, apart);
  const Vec3 direction = apart * (1 / std::sqrt(distance_sq));
  const Vec3 reflected = Bsdf(point, to_eye).evaluate(direction);
  if (!(reflected.x + reflected.y + reflected.z > 0)) return {0, 0, 0};
  if (!is_open(rays, rays.offset_from_surface(point.position, point.geometric_normal), light.position))
    return {0, 0, 0};
  return reflected * intensity_towards(light, -direction) * (1 / distance_sq);
}

struct Pixel {
  bool seen = false;
  float clearance = kFar;         // shortest way that a sampled ray went [m]
  std::vector<Vec3> batch_means;  // of the other road
};

Pixel other_road(const Stage& stage, const RayScene& rays, const CameraRays& camera, std::uint32_t x, std::uint32_t y) {
  Pixel pixel;
  const CameraRay ray = camera.ray(x, y, {0.5f, 0.5f}, {0.5f, 0.5f});
  SurfaceHit hit;
  float distance = 0;
  if (!trace(rays, ray.origin, ray.direction, 0, hit, distance)) return pixel;
  pixel.seen = true;
  const SurfacePoint at =
      evaluate_surface(*stage.scene, hit, ray.direction, camera.pixel_size() * camera.depth(ray.direction, distance));
  const Bsdf bsdf(at, -ray.direction);
  const Vec3 origin = rays.offset_from_surface(at.position, at.geometric_normal);
  for (std::uint32_t batch = 0; batch < kBatches; ++batch) {
    Vec3 sum(0, 0, 0);
    for (std::uint32_t i = 0; i < kSamplesPerBatch; ++i) {
      // Every batch a pixel of its own: independent of the others.
      SampleSequence numbers(17, (y * kWidth + x) * kBatches + batch, i);
      const Vec2 place = numbers.pair();
      const BsdfSample sample = bsdf.sample(place, numbers.pair().x);
      if (!(sample.pdf > 0)) continue;
      float nearest = 0;
      for (int surface = 0; surface < 64 && trace(rays, origin, sample.direction, nearest, hit, distance); ++surface) {
        if (surface == 0) pixel.clearance = std::min(pixel.clearance, distance);
        const SurfacePoint met = evaluate_surface(*stage.scene, hit, sample.direction, 0);
        sum += sample.weight * lit_radiance(rays, stage.light, met, -sample.direction);
        nearest = distance + 2 * rays.surface_offset();
      }
    }
    pixel.batch_means.push_back(sum / static_cast<float>(kSamplesPerBatch));
  }
  return pixel;
}

// The frame's indirect light for one seed of the virtual lights; `spoil` multiplies it.
std::vector<Vec3> frame(const Stage& stage, std::uint64_t vpl_seed) {
  Settings settings;
  settings.width = kWidth, settings.height = kHeight, settings.vpls = 256;
  settings.ranges = Ranges::infinite, settings.culling = Culling::none, settings.interleave = 1;
  settings.filter = Filter::none, settings.near_field = NearField::point, settings.vpl_seed = vpl_seed;
  Result<Renderer> renderer = Renderer::create(stage.scene, stage.camera, {stage.light}, settings);
  EXPECT_TRUE(renderer.has_value());
  return renderer->render(0, {"indirect"})->layers.colours("indirect");
}

struct Moments {
  double sum = 0, squares = 0, count = 0;
  void add(double v) { sum += v, squares += v * v, ++count; }
  double mean() const { return sum / count; }
  double variance_of_mean() const { return (squares / count - mean() * mean()) / (count - 1); }
};

struct Verdict {
  double largest = 0, mean_square = 0;  // of z
  int values = 0;
  double ratio_elsewhere = 0;  // frame to the other road, over pixels near other surfaces
};

Verdict test(const std::string& address, double spoil) {
  const Stage scene = stage(address);
  const Result<RayScene> rays = RayScene::create(scene.scene);
  PathSettings settings;
  settings.width = kWidth, settings.height = kHeight, settings.pixel_filter = PixelFilter::box;
  const CameraRays camera(scene.camera, settings);
  std::vector<Pixel> pixels;
  for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
    pixels.push_back(other_road(scene, *rays, camera, i % kWidth, i / kWidth));
  }
  const float clear = 0.1f * rays->bounds().diagonal();
  constexpr std::uint32_t kColumns = kWidth / kBlock, kBlocks = kColumns * (kHeight / kBlock);
  std::vector<Moments> by_frame(kBlocks * 3), by_ray(kBlocks * 3);
  double near_frame = 0, near_ray = 0;
  const auto collect = [&](std::vector<Moments>& moments, const auto& value, double& near) {
    std::vector<double> sum(kBlocks * 3, 0.0), count(kBlocks, 0.0);
    for (std::uint32_t i = 0; i < pixels.size(); ++i) {
      if (!pixels[i].seen) continue;
      const Colour colour = colour_of(value(i));
      if (pixels[i].clearance < clear) {
        near += colour[0] + colour[1] + colour[2];
        continue;
      }
      const std::uint32_t block = i / kWidth / kBlock * kColumns + i % kWidth / kBlock;
      for (std::size_t c = 0; c < 3; ++c) sum[block * 3 + c] += colour[c];
      ++count[block];
    }
    for (std::uint32_t block = 0; block < kBlocks; ++block) {
      for (std::size_t c = 0; c < 3 && count[block] >= 8; ++c)
        moments[block * 3 + c].add(sum[block * 3 + c] / count[block]);
    }
  };
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Vec3> light = frame(scene, seed);
    collect(
        by_frame, [&](std::uint32_t i) { return light[i] * static_cast<float>(spoil); }, near_frame);
  }
  for (std::uint32_t batch = 0; batch < kBatches; ++batch) {
    collect(
        by_ray, [&](std::uint32_t i) { return pixels[i].batch_means[batch]; }, near_ray);
  }
  Verdict verdict;
  for (std::size_t i = 0; i < by_frame.size(); ++i) {
    if (by_frame[i].count == 0) continue;
    const double variance = by_frame[i].variance_of_mean() + by_ray[i].variance_of_mean();
    if (!(variance > 0)) continue;
    const double z = (by_frame[i].mean() - by_ray[i].mean()) / std::sqrt(variance);
    verdict.largest = std::max(verdict.largest, std::abs(z));
    verdict.mean_square += z * z, ++verdict.values;
  }
  verdict.mean_square /= std::max(verdict.values, 1);
  verdict.ratio_elsewhere = near_frame / kSeeds / (near_ray / kBatches);
  return verdict;
}

// Sidak's limit for some 30 values is 3.6; the blocks' seeds are shared, so that their deviations go together.
constexpr double kLimit = 4;

class IndirectTruth : public testing::TestWithParam<std::string> {};

TEST_P(IndirectTruth, frame_and_rays_agree) {
  const Verdict verdict = test(GetParam(), 1);
  EXPECT_GE(verdict.values, 12);
  EXPECT_LT(verdict.largest, kLimit) << "mean square " << verdict.mean_square;
  RecordProperty("ratio_near_other_surfaces", std::to_string(verdict.ratio_elsewhere));
  std::printf("%s: largest |z| %.2f of %d, mean square %.2f; near other surfaces the ratio is %.3f\n",
              GetParam().c_str(), verdict.largest, verdict.values, verdict.mean_square, verdict.ratio_elsewhere);
}

INSTANTIATE_TEST_SUITE_P(Scenes, IndirectTruth, testing::Values("recipe:cornell", "recipe:cornell?glossy=0.3"));

TEST(IndirectTruth, a_frame_five_percent_too_bright_is_caught) {
  EXPECT_GT(test("recipe:cornell", 1.05).largest, kLimit);
}

}  // namespace
}  // namespace luciole
