// SPDX-License-Identifier: Apache-2.0
// How far each choice of lights comes in equal time.
//   equal_time_benchmark SECONDS[,SECONDS...] REFERENCE_SECONDS WIDTHxHEIGHT SCENE ...     prints Markdown
// All choices get the first time; culling, the tree and uniform choice go on to the others.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "benchmarks/stage.h"
#include "offline/light_set/light_set.h"
#include "offline/render.h"

namespace luciole {
namespace {

// More lights than that, all weighed for each choice, take longer than a sample may.
constexpr std::uint32_t kMostExhaustive = 6000;

struct Job {
  std::vector<double> seconds;  // ascending
  double reference_seconds;
  std::string size;
};

struct Outcome {
  Image image;
  double samples = 0, seconds = 0;
};

// Whole samples of every pixel until the time is up, at least one; what there is at each of several times.
std::vector<Outcome> render(const Stage& stage, const PathSettings& settings, const std::vector<double>& times) {
  Result<PathTracer> tracer = PathTracer::create(stage.scene, stage.camera, settings);
  if (!tracer) std::exit(1);
  Film film(settings.width, settings.height, settings.exposure);
  std::vector<Outcome> outcomes;
  double samples = 0, seconds = 0;
  for (const double time : times) {
    while (samples == 0 || seconds * (1 + 0.5 / samples) < time) {
      seconds += seconds_of([&] { tracer->add_sample(film); });
      ++samples;
    }
    outcomes.push_back({film.image(), samples, seconds});
  }
  return outcomes;
}

// Two renders with random numbers of their own: their mean is the reference, their difference tells its variance.
struct Reference {
  std::vector<Vec3> mean, variance;
  double brightness = 0;  // mean over pixels and channels
  double samples = 0;
};

Reference render_reference(const Stage& stage, PathSettings settings, double seconds) {
  Reference reference;
  std::vector<Vec3> half[2];
  for (int k = 0; k < 2; ++k) {
    settings.seed = 1000 + static_cast<std::uint64_t>(k);
    const Outcome outcome = render(stage, settings, {seconds / 2}).back();
    half[k] = outcome.image.colours(""), reference.samples += outcome.samples;
  }
  for (std::size_t i = 0; i < half[0].size(); ++i) {
    const Vec3 a = half[0][i], b = half[1][i], mean = (a + b) * 0.5f, apart = (a - b) * 0.5f;
    reference.mean.push_back(mean), reference.variance.push_back(apart * apart);
    reference.brightness += channel_mean(mean) / static_cast<double>(half[0].size());
  }
  return reference;
}

struct Errors {
  double mse = 0, relmse = 0;
};

// Against the truth: the mean square distance from the reference, less the reference's own variance.
Errors errors_of(const Image& image, const Reference& reference) {
  const std::vector<Vec3> colours = image.colours("");
  const auto count = static_cast<double>(colours.size());
  Errors errors;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const Vec3 x = colours[i], r = reference.mean[i], v = reference.variance[i];
    double sum = 0;
    for (const auto& [picture, truth, noise] : {std::array{x.x, r.x, v.x}, {x.y, r.y, v.y}, {x.z, r.z, v.z}}) {
      const double square = (double(picture) - truth) * (double(picture) - truth) - noise;
      errors.mse += square / 3 / count;
      sum += square / (double(truth) * truth + 0.01 * reference.brightness * reference.brightness) / 3;
    }
    errors.relmse += sum / count;
  }
  return errors;
}

void print_scene(const std::string& name, const Job& job, std::uint32_t bounces) {
  const Stage stage = with_primaries(open_stage(name, {}));
  PathSettings settings;
  settings.exposure = stage.settings.exposure, settings.bounces = bounces;
  (void)path_setting_table().set(settings, "size", job.size);
  const Reference reference = render_reference(stage, settings, job.reference_seconds);
  std::printf("\n## `%s`, %u bounce%s\n\nReference: culling, %.0f samples.\n\n", name.c_str(), bounces,
              bounces == 1 ? "" : "s", reference.samples);
  std::printf("| choice | samples | s | RMSE | relMSE | to culling |\n");
  std::printf("| --- | ---: | ---: | ---: | ---: | ---: |\n");
  const std::uint32_t lights = LightSet(*stage.scene).size();
  std::vector<double> culling;  // its relMSE at each time
  for (const LightChoice choice : {LightChoice::culling, LightChoice::tree, LightChoice::power, LightChoice::uniform,
                                   LightChoice::clamped, LightChoice::exhaustive}) {
    if (choice == LightChoice::exhaustive && lights > kMostExhaustive) continue;
    settings.lights = choice, settings.seed = 1;
    const bool goes_on =
        choice == LightChoice::culling || choice == LightChoice::tree || choice == LightChoice::uniform;
    const std::vector<Outcome> outcomes =
        render(stage, settings, goes_on ? job.seconds : std::vector<double>{job.seconds.front()});
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      Errors errors = errors_of(outcomes[k].image, reference);
      // In exactly the time given: an unbiased estimate's relMSE falls as 1 / time.
      if (choice != LightChoice::clamped) errors.relmse *= outcomes[k].seconds / job.seconds[k];
      if (choice == LightChoice::culling) culling.push_back(errors.relmse);
      std::printf("| %s | %.0f | %.1f | %.4g | %.4g | %.2f |\n", name_of(choice).c_str(), outcomes[k].samples,
                  outcomes[k].seconds, std::sqrt(std::max(errors.mse, 0.0)), errors.relmse, errors.relmse / culling[k]);
    }
    std::fflush(stdout);
  }
}

std::vector<double> times_of(const std::string& text) {
  std::vector<double> times;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) times.push_back(std::atof(word.c_str()));
  return times;
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  if (argc < 5) {
    std::fprintf(stderr, "usage: equal_time_benchmark SECONDS[,SECONDS...] REFERENCE_SECONDS WIDTHxHEIGHT SCENE ...\n");
    return 2;
  }
  const Job job{times_of(argv[1]), std::atof(argv[2]), argv[3]};
  for (int i = 4; i < argc; ++i) {
    for (const std::uint32_t bounces : {1u, 3u}) print_scene(argv[i], job, bounces);
  }
}
