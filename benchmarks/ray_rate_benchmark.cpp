// SPDX-License-Identifier: Apache-2.0
// Rays per second of frame and path tracer, beside what the same rays take when nothing but tracing is done.
//   ray_rate_benchmark SCENE ...     prints Markdown
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "benchmarks/stage.h"
#include "equations/cpp/float.h"
#include "offline/path/bsdf.h"
#include "offline/path/camera_rays.h"
#include "offline/render.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"

namespace luciole {
namespace {

constexpr std::uint32_t kWidth = 1280, kHeight = 720, kSide = 4;  // a packet: the rays of 4x4 pixels
constexpr int kRuns = 5;

using Packets = std::vector<RayPacket>;

template <class Trace>
double median_seconds(const Packets& packets, const Trace& trace) {
  std::vector<double> seconds;
  for (int run = 0; run < kRuns; ++run) {
    seconds.push_back(seconds_of([&] {
      parallel_for(packets.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) trace(packets[i]);
      });
    }));
  }
  return median(seconds);
}

struct Rays {
  Packets primary, diffuse, shadow;
};

// From every pixel a ray; from what it meets one by the cosine, and one to a place in the box round the scene.
Rays rays_of(const RayScene& scene, const Camera& camera, const PathSettings& settings) {
  GeometryBuffer buffer;
  render_geometry_buffer({scene, camera, kWidth, kHeight}, buffer);
  const auto vector = [](const Plane3& plane, std::size_t at) {
    return Vec3(plane[0][at], plane[1][at], plane[2][at]);
  };
  const auto unit = [](std::uint32_t bits) { return static_cast<float>(bits) * 0x1p-32f; };
  const CameraRays cameras(camera, settings);
  const float far = 1e30f;
  const Bounds& box = scene.bounds();
  Rays rays;
  for (std::uint32_t block = 0; block < kWidth * kHeight / kPacketRays; ++block) {
    RayPacket primary, diffuse, shadow;
    for (std::uint32_t i = 0; i < kPacketRays; ++i) {
      const auto lane = static_cast<int>(i);
      const std::uint32_t x = block % (kWidth / kSide) * kSide + i % kSide,
                          y = block / (kWidth / kSide) * kSide + i / kSide;
      const std::size_t pixel = std::size_t(y) * kWidth + x;
      const CameraRay ray = cameras.ray(x, y, {0.5f, 0.5f}, {0.5f, 0.5f});
      primary.set(lane, ray.origin, ray.direction, 0, far);
      if (buffer.depth[pixel] == kNoSurface) {
        diffuse.skip(lane), shadow.skip(lane);
        continue;
      }
      const f32::RandomWords a = f32::random_words(1, 2, x, y), b = f32::random_words(3, 4, x, y);
      const Vec3 normal = vector(buffer.geometric_normal, pixel);
      const Vec3 origin = scene.offset_from_surface(vector(buffer.position, pixel), normal);
      const float level = std::sqrt(unit(a.first)), turn = 6.2831853f * unit(a.second);
      const TangentFrame frame(normal);
      diffuse.set(lane, origin,
                  frame.x * (level * std::cos(turn)) + frame.y * (level * std::sin(turn)) +
                      normal * std::sqrt(1 - level * level),
                  0, far);
      const Vec3 place(unit(b.first), unit(b.second), unit(a.first ^ b.second));
      shadow.set(lane, origin, box.low + (box.high - box.low) * place - origin, 0, 1);
    }
    rays.primary.push_back(primary), rays.diffuse.push_back(diffuse), rays.shadow.push_back(shadow);
  }
  return rays;
}

void print_row(const char* what, double rays, double bare_seconds, double seconds) {
  std::printf("| %s | %.2f | %.2f | %.0f %% |\n", what, rays / bare_seconds * 1e-6, rays / seconds * 1e-6,
              100 * bare_seconds / seconds);
}

void print_scene(const std::string& name) {
  const Stage stage = open_stage(name, {});
  PathSettings settings;
  settings.width = kWidth, settings.height = kHeight;
  settings.isa = stage.settings.isa, settings.exposure = stage.settings.exposure;
  const Result<RayScene> scene = RayScene::create(stage.scene);
  if (!scene) std::exit(1);
  const Rays rays = rays_of(*scene, stage.camera, settings);
  const double count = double(kWidth) * kHeight;
  volatile std::uint32_t kept = 0;  // what is found must not be optimised away
  const auto meet = [&](Coherence coherence) {
    return [&scene, &kept, coherence](const RayPacket& packet) { kept = scene->intersect(packet, coherence).mesh[0]; };
  };
  const double primary = median_seconds(rays.primary, meet(Coherence::coherent));
  const double diffuse = median_seconds(rays.diffuse, meet(Coherence::incoherent));
  const double shadow = median_seconds(
      rays.shadow, [&](const RayPacket& packet) { kept = scene->occluded(packet, Coherence::incoherent); });
  std::printf("\n## `%s`\n\nBare: primary %.1f, diffuse bounce %.1f, shadow %.1f million rays per second.\n\n",
              name.c_str(), count / primary * 1e-6, count / diffuse * 1e-6, count / shadow * 1e-6);
  std::printf("| | bare, million rays per second | with shading | share |\n| --- | ---: | ---: | ---: |\n");
  std::vector<double> seconds;
  GeometryBuffer buffer;
  for (int run = 0; run < kRuns; ++run) {
    seconds.push_back(seconds_of([&] {
      render_geometry_buffer({*scene, stage.camera, kWidth, kHeight, {0.5f, 0.5f}, settings.isa}, buffer);
    }));
  }
  print_row("the frame's geometry buffer", count, primary, median(seconds));
  for (const std::uint32_t bounces : {1u, 3u}) {
    settings.bounces = bounces;
    Result<PathTracer> tracer = PathTracer::create(stage.scene, stage.camera, settings);
    if (!tracer) std::exit(1);
    Film film(kWidth, kHeight, settings.exposure);
    seconds.clear();
    for (int run = 0; run < kRuns; ++run) seconds.push_back(seconds_of([&] { tracer->add_sample(film); }));
    const PathStatistics& statistics = tracer->statistics();
    const auto all = static_cast<double>(statistics.rays) / kRuns;
    const double asking = std::min(static_cast<double>(statistics.light_choices) / kRuns, all - count);
    const double bare = primary + asking / count * shadow + (all - count - asking) / count * diffuse;
    print_row(bounces == 1 ? "paths of one scattering" : "paths of three scatterings", all, bare, median(seconds));
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  luciole::print_page_head("Rays per second", "benchmarks/run.sh ray_rate");
  std::printf(
      "\n1280x720, all cores, medians of five. Bare: packets of 16 rays made ready in memory go through the tree of "
      "triangles,\n"
      "nothing else is done. With shading: the geometry buffer makes its rays, evaluates material, textures and normal "
      "where\n"
      "they meet a surface, and writes 19 planes; the path tracer also chooses lights, samples BSDFs and adds to the "
      "film. Its\n"
      "bare time is that of as many primary, shadow (one per choice of a light) and diffuse rays.\n");
  for (int i = 1; i < argc; ++i) luciole::print_scene(argv[i]);
}
