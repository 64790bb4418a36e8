// SPDX-License-Identifier: Apache-2.0
// What the variance of a path traced picture is made of.
//   variance_parts_benchmark SCENE ...     prints Markdown
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "benchmarks/learned_visibility.h"
#include "benchmarks/stage.h"
#include "offline/light_sample/light_point.h"
#include "offline/light_sample/make_light_sampler.h"
#include "offline/path/bsdf.h"
#include "offline/path/path_batch.h"
#include "offline/path/probe_paths.h"
#include "offline/render.h"

namespace luciole {
namespace {

constexpr std::uint32_t kPixels = 8192;  // of the picture
constexpr std::uint32_t kPlaces = 4;     // of the camera's ray in each
constexpr std::uint32_t kPasses = 8;     // new ranges, for the same rays
constexpr float kLearnedCells = 64;      // of the scene's diagonal: edge of a cube in which visibility is shared
constexpr std::uint32_t kLearnedLights = 32, kLearningPasses = 64;
constexpr int kSamples[] = {32, 8};  // of the whole picture, at 1 and 3 bounces

// Direct light of lamps and emissive triangles at one surface point, once.
struct Sample {
  Vec3 first, second;  // the chosen light's, for two places on it: what a shadow ray brings, weighted
  Vec3 correction;     // of its colour
  Vec3 unoccluded;     // mean of both, were nothing in the way
  std::uint32_t chosen = kNoLight;
  Receiver receiver{};
  Vec3 bsdf;  // what the ray that the BSDF samples brings
};

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

  // Replaces the choice by one that has learned from this many shadow rays of each pixel, in passes of their own.
  void learn_visibility(const std::vector<std::uint32_t>& pixels, std::uint32_t passes) {
    CullingParameters parameters;
    parameters.radiance_floor = sampler_->error_bound() * 2 * std::numbers::pi_v<float> / settings_.exposure;
    parameters.exposure = settings_.exposure, parameters.scene_diagonal = rays_.bounds().diagonal();
    auto learned = std::make_unique<LearnedVisibilitySampler>(
        lights_, settings_, parameters, parameters.scene_diagonal / kLearnedCells, kLearnedLights);
    LearnedVisibilitySampler& learns = *learned;
    sampler_ = std::move(learned);
    for (std::uint32_t pass = kPasses; pass < kPasses + passes; ++pass) {
      sampler_->begin_pass(pass);
      for (const std::uint32_t pixel : pixels) {
        const Sample found = sample(pixel, pass % kPlaces, pass);
        if (found.chosen != kNoLight && !is_black(found.unoccluded)) {
          learns.learn(found.receiver, found.chosen, !is_black(found.first));
        }
      }
    }
  }

  // Of each pixel: kPlaces sums over passes.
  std::vector<Channels> measure(const std::vector<std::uint32_t>& pixels) {
    std::vector<Channels> sums(pixels.size() * kPlaces);
    for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
      sampler_->begin_pass(pass);
      parallel_for(pixels.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * kPlaces; i < end * kPlaces; ++i) {
          add(sums[i], sample(pixels[i / kPlaces], static_cast<std::uint32_t>(i % kPlaces), pass));
        }
      });
    }
    return sums;
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
    const LightPoint light = by_area_ ? point_by_area(record, point.position, place)
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
    light.pdf = record.lamp > 0 ? 1.0f : density_by_area(record, light, receiver);
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
    if (variant.learned) light.learn_visibility(pixels, kLearningPasses);
    const Parts p = mean_parts(light.measure(pixels), pixels, direct);
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
