// SPDX-License-Identifier: Apache-2.0
// How far each choice of lights comes in equal time, against a reference of many times that.
//   equal_time_benchmark SECONDS REFERENCE_SECONDS WIDTHxHEIGHT SCENE ...     prints Markdown
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "benchmarks/stage.h"
#include "image/metrics.h"
#include "offline/render.h"

namespace luciole {
namespace {

struct Job {
  double seconds, reference_seconds;
  std::string size;
};

struct Outcome {
  Image image;
  double samples = 0, seconds = 0;
};

// Whole samples of every pixel until the time is up, at least one.
Outcome render(const Stage& stage, const PathSettings& settings, double seconds) {
  Result<PathTracer> tracer = PathTracer::create(stage.scene, stage.camera, settings);
  if (!tracer) std::exit(1);
  Film film(settings.width, settings.height, settings.exposure);
  Outcome outcome;
  const double start = now_seconds();
  do {
    tracer->add_sample(film);
    ++outcome.samples;
    outcome.seconds = now_seconds() - start;
  } while (outcome.seconds * (1 + 0.5 / outcome.samples) < seconds);
  outcome.image = film.image();
  return outcome;
}

// relMSE without the twentieth of the pixels that are worst: those that show a lamp's edge.
double best_relmse(const Image& image, const Image& reference) {
  const std::vector<Vec3> x = image.colours(""), r = reference.colours("");
  double mean = 0;
  for (const Vec3& pixel : r) mean += (double(pixel.x) + pixel.y + pixel.z) / 3;
  mean /= static_cast<double>(r.size());
  std::vector<double> errors;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a[3] = {x[i].x, x[i].y, x[i].z}, b[3] = {r[i].x, r[i].y, r[i].z};
    double error = 0;
    for (int c = 0; c < 3; ++c) error += (a[c] - b[c]) * (a[c] - b[c]) / (b[c] * b[c] + 0.01 * mean * mean) / 3;
    errors.push_back(error);
  }
  std::sort(errors.begin(), errors.end());
  const std::size_t kept = errors.size() * 19 / 20;
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += errors[i];
  return sum / static_cast<double>(kept);
}

void print_scene(const std::string& name, const Job& job, std::uint32_t bounces) {
  Stage stage = open_stage(name, {});
  auto scene = std::make_shared<Scene>(*stage.scene);
  for (const PunctualLight& light : stage.primaries) {
    const auto same = [&](const PunctualLight& other) {
      return length(other.position - light.position) == 0 && length(other.intensity - light.intensity) == 0;
    };
    if (std::none_of(scene->lights.begin(), scene->lights.end(), same)) scene->lights.push_back(light);
  }
  stage.scene = scene;
  PathSettings settings;
  settings.exposure = stage.settings.exposure, settings.bounces = bounces;
  (void)path_setting_table().set(settings, "size", job.size);
  settings.seed = 1000;
  const Outcome reference = render(stage, settings, job.reference_seconds);
  settings.seed = 1;
  std::printf("\n## `%s`, %u bounce%s\n\nReference: culling, %.0f samples.\n\n", name.c_str(), bounces,
              bounces == 1 ? "" : "s", reference.samples);
  std::printf("| choice | samples | s | RMSE | relMSE | to culling | relMSE, best 95 %% | to culling |\n");
  std::printf("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  double culling = 0, culling_best = 0;
  for (const LightChoice lights : {LightChoice::culling, LightChoice::tree, LightChoice::power, LightChoice::uniform}) {
    settings.lights = lights;
    const Outcome outcome = render(stage, settings, job.seconds);
    const Result<Comparison> difference = compare(outcome.image, reference.image);
    if (!difference) continue;
    // In exactly the time given: relMSE falls as 1 / time.
    const double relmse = difference->relmse * outcome.seconds / job.seconds;
    const double best = best_relmse(outcome.image, reference.image) * outcome.seconds / job.seconds;
    if (lights == LightChoice::culling) culling = relmse, culling_best = best;
    std::printf("| %s | %.0f | %.1f | %.4g | %.4g | %.2f | %.4g | %.2f |\n", name_of(lights).c_str(), outcome.samples,
                outcome.seconds, difference->rmse, relmse, relmse / culling, best, best / culling_best);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  if (argc < 5) {
    std::fprintf(stderr, "usage: equal_time_benchmark SECONDS REFERENCE_SECONDS WIDTHxHEIGHT SCENE ...\n");
    return 2;
  }
  const Job job{std::atof(argv[1]), std::atof(argv[2]), argv[3]};
  print_page_head("Path tracing in equal time", "benchmarks/run.sh equal_time");
  std::printf(
      "\n%s, %.0f s each on all cores; relMSE as measured times the time taken over the time given. Reference: %.0f s "
      "with\n"
      "other random numbers. The best 95 %% leave out pixels that show lamps, whose error no choice of lights "
      "changes.\n",
      job.size.c_str(), job.seconds, job.reference_seconds);
  for (int i = 4; i < argc; ++i) {
    for (const std::uint32_t bounces : {1u, 3u}) print_scene(argv[i], job, bounces);
  }
}
