// SPDX-License-Identifier: Apache-2.0
// What the variance of a path traced picture is made of.
//   variance_parts_benchmark SCENE ...     prints Markdown
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "benchmarks/direct_light_probe.h"
#include "benchmarks/stage.h"
#include "offline/render.h"

namespace luciole {
namespace {

constexpr std::uint32_t kPixels = 8192;  // of the picture
constexpr std::uint32_t kPlaces = 4;     // of the camera's ray in each
constexpr std::uint32_t kPasses = 8;     // new ranges, for the same rays
constexpr float kLearnedCells = 64;      // of the scene's diagonal: edge of a cube in which visibility is shared
constexpr std::uint32_t kLearningPasses = 64;
constexpr int kSamples[] = {32, 8};  // of the whole picture, at 1 and 3 bounces

// One channel of one camera ray: sums over passes, and of products that are needed.
struct Sums {
  double light = 0, light_sq = 0, places = 0, within = 0;
  double seen = 0, unoccluded = 0, seen_unoccluded = 0;
  double bsdf = 0, bsdf_sq = 0, all = 0, all_sq = 0;

  //   correction  of the colour, part of both
  void add(double first, double second, double correction, double if_unoccluded, double by_bsdf) {
    const double product = first * second;
    first += correction, second += correction;
    const double mean = (first + second) / 2;
    light += mean, light_sq += mean * mean;
    places += first * second, within += (first - second) * (first - second) / 2;
    const double visible = if_unoccluded > 0 ? product / if_unoccluded : 0;
    seen += visible, unoccluded += if_unoccluded, seen_unoccluded += visible * if_unoccluded;
    bsdf += by_bsdf, bsdf_sq += by_bsdf * by_bsdf;
    all += mean + by_bsdf, all_sq += (mean + by_bsdf) * (mean + by_bsdf);
  }
};
using Channels = std::array<Sums, 4>;  // R, G, B, their mean
constexpr std::size_t kGrey = 3;

void add(Channels& sums, const Sample& s) {
  sums[0].add(s.first.x, s.second.x, s.correction.x, s.unoccluded.x, s.bsdf.x);
  sums[1].add(s.first.y, s.second.y, s.correction.y, s.unoccluded.y, s.bsdf.y);
  sums[2].add(s.first.z, s.second.z, s.correction.z, s.unoccluded.z, s.bsdf.z);
  sums[kGrey].add(channel_mean(s.first), channel_mean(s.second), channel_mean(s.correction), channel_mean(s.unoccluded),
                  channel_mean(s.bsdf));
}

// Mean of x times mean of y from n independent pairs, without the bias of each pair's own product.
double product_of_means(double sum_x, double sum_y, double sum_xy, double n) {
  return (sum_x * sum_y - sum_xy) / (n * (n - 1));
}

// Variances per sample, by the law of total variance.
struct Parts {
  double selection = 0, colour = 0, visibility = 0, place = 0, bsdf = 0, pixel = 0;
  void add(const Parts& other, double scale) {
    selection += other.selection * scale, visibility += other.visibility * scale, place += other.place * scale;
    bsdf += other.bsdf * scale, pixel += other.pixel * scale;
  }
  double sum() const { return selection + colour + visibility + place + bsdf + pixel; }
};

Parts parts_of(const Channels* places, std::size_t channel) {
  Parts parts;
  double mean_sum = 0, mean_sq_sum = 0, square_of_means = 0;
  for (std::uint32_t k = 0; k < kPlaces; ++k) {
    const Sums& s = places[k][channel];
    const double n = kPasses, square = product_of_means(s.light, s.light, s.light_sq, n);
    // Sum over lights of H^2 / U, H what arrives and U what would, times the sum of U: the second moment of a choice
    // that is exactly as probable as U.
    const double ideal = product_of_means(s.seen, s.unoccluded, s.seen_unoccluded, n);
    parts.selection += (s.places / n - ideal) / kPlaces;
    parts.visibility += (ideal - square) / kPlaces;
    parts.place += s.within / n / kPlaces;
    parts.bsdf += (s.bsdf_sq / n - product_of_means(s.bsdf, s.bsdf, s.bsdf_sq, n)) / kPlaces;
    square_of_means += product_of_means(s.all, s.all, s.all_sq, n) / kPlaces;
    mean_sum += s.all / n, mean_sq_sum += (s.all / n) * (s.all / n);
  }
  parts.pixel = square_of_means - product_of_means(mean_sum, mean_sum, mean_sq_sum, kPlaces);
  return parts;
}

// The picture's own variance per sample over the squares that relMSE divides by, and those squares.
struct Picture {
  double variance = 0, dark = 0;     // dark: what relMSE adds to the squares
  std::vector<Vec3> squares, means;  // by pixel
};

Picture render(const Stage& stage, const PathSettings& settings, int samples) {
  Result<PathTracer> tracer = PathTracer::create(stage.scene, stage.camera, settings);
  if (!tracer) std::exit(1);
  Film film(settings.width, settings.height, settings.exposure);
  for (int i = 0; i < samples; ++i) tracer->add_sample(film);
  const Image image = film.image({"variance"});
  const std::vector<Vec3> mean = image.colours(""), variance = image.colours("variance");
  double brightness = 0;
  for (const Vec3& m : mean) brightness += channel_mean(m) / static_cast<double>(mean.size());
  Picture picture;
  picture.means = mean, picture.dark = 0.01 * brightness * brightness;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const auto dark = static_cast<float>(picture.dark);
    const Vec3 squares = mean[i] * mean[i] + Vec3(dark, dark, dark);
    picture.squares.push_back(squares);
    const Vec3 v = variance[i];
    picture.variance += samples * channel_mean(Vec3(v.x / squares.x, v.y / squares.y, v.z / squares.z)) /
                        static_cast<double>(mean.size());
  }
  return picture;
}

Parts mean_parts(const std::vector<Channels>& sums, const std::vector<std::uint32_t>& pixels, const Picture& picture) {
  Parts mean;
  double grey = 0;  // selection, as if all lights were white
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Vec3 squares = picture.squares[pixels[i]];
    const std::array<double, 3> divisors{squares.x, squares.y, squares.z};
    for (std::size_t c = 0; c < 3; ++c) {
      mean.add(parts_of(&sums[i * kPlaces], c), 1 / (3 * divisors[c] * static_cast<double>(pixels.size())));
    }
    grey += parts_of(&sums[i * kPlaces], kGrey).selection /
            (channel_mean(picture.means[pixels[i]]) * channel_mean(picture.means[pixels[i]]) + picture.dark) /
            static_cast<double>(pixels.size());
  }
  mean.colour = mean.selection - grey, mean.selection = grey;
  return mean;
}

struct Variant {
  const char* name;
  LightChoice lights;
  RangeNumbers ranges;
  Importance importance;
  bool by_area = false, corrected = true, learned = false;
};
constexpr Variant kVariants[] = {
    {"culling", LightChoice::culling, RangeNumbers::independent, Importance::reflected},
    {"culling, stratified ranges", LightChoice::culling, RangeNumbers::stratified, Importance::reflected},
    {"culling, weights without the material", LightChoice::culling, RangeNumbers::independent, Importance::printed},
    {"culling, points by area", LightChoice::culling, RangeNumbers::independent, Importance::reflected, true},
    {"culling, colours as they come", LightChoice::culling, RangeNumbers::independent, Importance::reflected, false,
     false},
    {"the same, visibility learned", LightChoice::culling, RangeNumbers::independent, Importance::reflected, false,
     false, true},
    {"tree", LightChoice::tree, {}, {}},
    {"power", LightChoice::power, {}, {}},
};

void print_scene(const std::string& name) {
  const Stage stage = with_primaries(open_stage(name, {}));
  Result<RayScene> rays = RayScene::create(stage.scene);
  if (!rays) std::exit(1);
  PathSettings settings;
  settings.exposure = stage.settings.exposure, settings.isa = stage.settings.isa, settings.bounces = 1;
  const Picture direct = render(stage, settings, kSamples[0]);
  std::vector<std::uint32_t> pixels;
  const std::uint64_t all = std::uint64_t(settings.width) * settings.height;
  for (std::uint64_t i = 0; i < kPixels; ++i) {
    pixels.push_back(static_cast<std::uint32_t>((i * 2 + 1) * all / (2 * kPixels) + i * 7919 % 97) %
                     static_cast<std::uint32_t>(all));
  }
  std::printf("\n## `%s`\n\n| choice | selection | colour | visibility | place on the light | BSDF | pixel | sum |\n",
              name.c_str());
  std::printf("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const Variant& variant : kVariants) {
    settings.lights = variant.lights, settings.range_samples = variant.ranges, settings.importance = variant.importance;
    DirectLight light(stage, *rays, settings, variant.by_area, variant.corrected);
    if (variant.learned) light.learn_visibility(pixels, kPasses, kPasses + kLearningPasses);
    std::vector<Channels> sums(pixels.size() * kPlaces);
    light.measure(pixels, kPlaces, kPasses, [&](std::size_t i, std::uint32_t place, const Sample& sample) {
      add(sums[i * kPlaces + place], sample);
    });
    const Parts p = mean_parts(sums, pixels, direct);
    std::printf("| %s | %.3g | %.3g | %.3g | %.3g | %.3g | %.3g | %.3g |\n", variant.name, p.selection, p.colour,
                p.visibility, p.place, p.bsdf, p.pixel, p.sum());
    std::fflush(stdout);
  }
  settings = {.bounces = 3, .exposure = settings.exposure, .isa = settings.isa};
  std::printf("\nThe whole picture: %.3g at one bounce, %.3g at three.\n", direct.variance,
              render(stage, settings, kSamples[1]).variance);
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  luciole::print_page_head("What the variance is made of", "benchmarks/run.sh variance_parts");
  std::puts(
      "\nVariance of one sample of a pixel over mean^2 + 0.01 (the picture's mean)^2, mean over channels and 8,192 of "
      "the\n"
      "pixels of 1280x720, at one bounce: what relMSE times samples is. By the law of total variance, from choices "
      "and\n"
      "places on the chosen light that are drawn twice:\n\n"
      "- *selection*: which light, as far as a choice exactly proportional to unoccluded light would not have it; of "
      "the\n"
      "  channels' mean. Negative where colours' correction takes away some of the next two.\n"
      "- *colour*: the same of the channels apart, less that. One lamp's colour stands for all.\n"
      "- *visibility*: what is left with that ideal choice, because the chosen light may be hidden.\n"
      "- *place*: the point on the chosen light. *BSDF*: light that the BSDF's rays meet. *pixel*: where in the "
      "pixel.\n\n"
      "The whole picture also has lamps that the camera sees, sun and sky, and samples that are spread better than at\n"
      "random; three bounces have a brighter mean.");
  for (int i = 1; i < argc; ++i) luciole::print_scene(argv[i]);
}
