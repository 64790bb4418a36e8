// SPDX-License-Identifier: Apache-2.0
// How steady are 120 frames? Along a path of the camera, frame times and the change of a patch of the scene from frame
// to frame; with the camera at rest, that of the same patch and of pixels, and the autocorrelation of the error: shells
// would show along distance, the 8x8 grid at lag 8.
//   steadiness_benchmark [shot ...]     prints Markdown
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

#include "benchmarks/stage.h"
#include "real_time/frame.h"

namespace luciole {
namespace {

constexpr std::uint32_t kWidth = 480, kHeight = 270, kFrames = 120, kPatch = 32;  // [pixels]
constexpr std::uint32_t kLags[] = {1, 2, 4, 7, 8, 9, 16, 32, 64};                 // [pixels], along rows
constexpr std::size_t kLagCount = std::size(kLags);

// Steps out of the shot and back: 2 % of the scene aside and ahead, looking at what the shot looks at.
Camera on_path(const Camera& shot, float scene_size, std::uint32_t frame) {
  const float t = 6.2831853f * static_cast<float>(frame) / kFrames;
  const Vec3 centre = shot.eye + shot.forward * (0.3f * scene_size);
  const Vec3 eye = shot.eye + shot.right * (0.02f * scene_size * std::sin(t)) +
                   shot.forward * (0.02f * scene_size * (1 - std::cos(t)));
  return look_at(eye, centre, shot.vertical_fov);
}

std::vector<float> luminance(const std::vector<Vec3>& colours) {
  std::vector<float> y;
  y.reserve(colours.size());
  for (const Vec3& c : colours) y.push_back(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z);
  return y;
}

using Frames = std::vector<std::vector<float>>;  // luminance, per frame and pixel

std::vector<float> mean_of(const Frames& frames) {
  std::vector<double> sum(frames[0].size());
  for (const auto& frame : frames)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += frame[i];
  std::vector<float> mean;
  for (double s : sum) mean.push_back(static_cast<float>(s / static_cast<double>(frames.size())));
  return mean;
}

// Where the upper left pixel of the patch round a point of the scene lies, kept inside the picture.
struct Corner {
  std::uint32_t x = (kWidth - kPatch) / 2, y = (kHeight - kPatch) / 2;
};

Corner corner_round(Vec3 point, const Camera& camera) {
  const Vec3 from_eye = point - camera.eye;
  const float pixels = 0.5f * kHeight / (std::tan(0.5f * camera.vertical_fov) * dot(from_eye, camera.forward));
  const float x = 0.5f * kWidth + pixels * dot(from_eye, camera.right);
  const float y = 0.5f * kHeight - pixels * dot(from_eye, camera.up);
  const auto first = [](float centre, std::uint32_t size) {
    return static_cast<std::uint32_t>(
        std::lround(std::clamp(centre - 0.5f * kPatch, 0.0f, static_cast<float>(size - kPatch))));
  };
  return {first(x, kWidth), first(y, kHeight)};
}

double patch_mean(const std::vector<float>& frame, Corner corner) {
  double sum = 0;
  for (std::uint32_t y = 0; y < kPatch; ++y)
    for (std::uint32_t x = 0; x < kPatch; ++x) sum += frame[(corner.y + y) * kWidth + corner.x + x];
  return sum / (kPatch * kPatch);
}

// Root of the mean squared change from one value to the next, over their mean.
double relative_change(const std::vector<double>& values) {
  double changes = 0, sum = 0;
  for (std::size_t f = 0; f < values.size(); ++f) {
    if (f > 0) changes += (values[f] - values[f - 1]) * (values[f] - values[f - 1]);
    sum += values[f];
  }
  const double n = static_cast<double>(values.size());
  return std::sqrt(changes / (n - 1)) / std::max(sum / n, 1e-30);
}

// The same of single pixels, over the picture's mean.
double pixel_change(const Frames& frames) {
  double changes = 0, sum = 0;
  for (std::size_t f = 1; f < frames.size(); ++f)
    for (std::size_t i = 0; i < frames[f].size(); ++i) {
      const double d = double(frames[f][i]) - frames[f - 1][i];
      changes += d * d, sum += frames[f][i];
    }
  const double n = static_cast<double>(frames.size() - 1) * static_cast<double>(frames[0].size());
  return std::sqrt(changes / n) / std::max(sum / n, 1e-30);
}

// Autocorrelation of the error relative to the truth, along rows; every frame's mean error is taken out.
std::vector<double> autocorrelation(const Frames& frames, const std::vector<float>& truth) {
  std::vector<double> covariance(kLagCount), error(truth.size());
  double variance = 0, mean_truth = 0;
  for (float t : truth) mean_truth += t / static_cast<double>(truth.size());
  for (const auto& frame : frames) {
    double mean = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      error[i] = (double(frame[i]) - truth[i]) / (truth[i] + 0.1 * mean_truth);
      mean += error[i] / static_cast<double>(truth.size());
    }
    for (double& e : error) e -= mean;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x + 64 < kWidth; ++x) {
        const double* e = error.data() + std::size_t(y) * kWidth + x;
        variance += e[0] * e[0];
        for (std::size_t l = 0; l < kLagCount; ++l) covariance[l] += e[0] * e[kLags[l]];
      }
  }
  for (double& c : covariance) c /= std::max(variance, 1e-30);
  return covariance;
}

struct Figures {
  double p50 = 0, p99 = 0, moving_patch = 0, patch = 0, pixel = 0;
  std::vector<double> noisy, filtered;  // autocorrelations
};

// The patch lies round the point in the middle of the picture, and follows it.
void move_along(Renderer& renderer, const Stage& stage, Figures& figures) {
  const float size = stage.scene->bounds().diagonal();
  std::vector<double> times, patches;
  Vec3 point(0, 0, 0);
  for (std::uint32_t f = 0; f < kFrames; ++f) {
    const Camera camera = on_path(stage.camera, size, f);
    renderer.set_camera(camera);
    const Result<Frame> frame = renderer.render(f, {"depth"});
    if (!frame) continue;
    const float depth = frame->layers.channels.at("depth.V")[kHeight / 2 * kWidth + kWidth / 2];
    if (f == 0) point = camera.eye + camera.forward * (std::isfinite(depth) ? depth : size);
    times.push_back(frame->statistics.frame_ms);
    patches.push_back(patch_mean(luminance(frame->picture), corner_round(point, camera)));
  }
  figures.p50 = quantile(times, 0.5), figures.p99 = quantile(times, 0.99);
  figures.moving_patch = relative_change(patches);
}

void stay(Renderer& renderer, const Stage& stage, Figures& figures) {
  renderer.set_camera(on_path(stage.camera, stage.scene->bounds().diagonal(), 0));
  Frames noisy, filtered;
  std::vector<double> patches;
  for (std::uint32_t f = 0; f < kFrames; ++f) {
    const Result<Frame> frame = renderer.render(f, {"unfiltered"});
    if (!frame) return;
    filtered.push_back(luminance(frame->picture));
    noisy.push_back(luminance(frame->layers.colours("unfiltered")));
    patches.push_back(patch_mean(filtered.back(), {}));
  }
  figures.patch = relative_change(patches), figures.pixel = pixel_change(filtered);
  figures.noisy = autocorrelation(noisy, mean_of(noisy));
  figures.filtered = autocorrelation(filtered, mean_of(filtered));
}

Figures measure(const Stage& stage, bool stratified) {
  Settings settings = stage.settings;
  settings.stratified_ranges = stratified;
  Figures figures;
  Result<Renderer> renderer = Renderer::create(stage.scene, stage.camera, stage.primaries, settings);
  if (!renderer) return figures;
  move_along(*renderer, stage, figures);
  stay(*renderer, stage, figures);
  return figures;
}

void correlation_row(const char* what, const char* ranges, const std::vector<double>& correlation) {
  std::printf("| %s | %s |", what, ranges);
  for (double c : correlation) std::printf(" %.3f |", c);
  std::printf("\n");
}

void report(const std::string& name) {
  const Stage stage = open_stage(name, {{"size", std::to_string(kWidth) + "x" + std::to_string(kHeight)}});
  const Figures independent = measure(stage, false), stratified = measure(stage, true);
  std::printf(
      "\n## %s\n\n| ranges | frame, p50 [ms] | p99 [ms] | change of the patch, on the path | at rest | change of a "
      "pixel, "
      "at rest |\n| --- | ---: | ---: | ---: | ---: | ---: |\n",
      name.c_str());
  for (const Figures* f : {&independent, &stratified}) {
    std::printf("| %s | %.0f | %.0f | %.2f %% | %.2f %% | %.1f %% |\n",
                f == &independent ? "independent" : "stratified", f->p50, f->p99, 100 * f->moving_patch, 100 * f->patch,
                100 * f->pixel);
  }
  std::printf("\n| autocorrelation at lag | ranges |");
  for (std::uint32_t lag : kLags) std::printf(" %u |", lag);
  std::printf("\n| --- | --- |");
  for (std::size_t l = 0; l < kLagCount; ++l) std::printf(" ---: |");
  std::printf("\n");
  correlation_row("unfiltered", "independent", independent.noisy);
  correlation_row("unfiltered", "stratified", stratified.noisy);
  correlation_row("filtered", "independent", independent.filtered);
  correlation_row("filtered", "stratified", stratified.filtered);
  std::fflush(stdout);
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) {
    names = {"gallery"};
    if (has_scenes()) names.insert(names.end(), {"sponza", "sibenik"});
  }
  print_page_head("Steadiness", "benchmarks/run.sh steadiness");
  std::printf(
      "\n%ux%u, 65,536 virtual point lights, new random ranges per frame, once %u frames along a path of the camera\n"
      "round the shot's eye (2 %% of the scene aside and ahead) and once %u frames at rest. Changes are root mean\n"
      "squares from frame to frame, over the mean, of the filtered picture: of a single pixel, and of the mean of a\n"
      "patch of %ux%u pixels round the point of the scene in the middle of the first frame. On the path they hold\n"
      "what the camera's motion changes, too. Errors are relative, against the mean of the %u frames; their\n"
      "autocorrelation runs along rows, lags in pixels. The 8x8 grid shows where lag 8 stands above lags 7 and 9.\n",
      kWidth, kHeight, kFrames, kFrames, kPatch, kPatch, kFrames);
  for (const std::string& name : names) report(name);
  return 0;
}
