// SPDX-License-Identifier: Apache-2.0
// How steady are 120 frames? Frame times along a path of the camera; with the camera at rest, the change from frame to
// frame and the autocorrelation of the error: shells would show along distance, the 8x8 grid at lag 8.
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

// Root of the mean squared change of the patch's mean, over its mean, from frame to frame; the patch in the middle.
double patch_change(const Frames& frames) {
  double before = 0, changes = 0, sum = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    double patch = 0;
    for (std::uint32_t y = 0; y < kPatch; ++y)
      for (std::uint32_t x = 0; x < kPatch; ++x) {
        patch += frames[f][(kHeight / 2 - kPatch / 2 + y) * kWidth + kWidth / 2 - kPatch / 2 + x];
      }
    if (f > 0) changes += (patch - before) * (patch - before);
    sum += patch, before = patch;
  }
  const double n = static_cast<double>(frames.size());
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
  double p50 = 0, p99 = 0, patch = 0, pixel = 0;
  std::vector<double> noisy, filtered;  // autocorrelations
};

Figures measure(const Stage& stage, bool stratified) {
  Settings settings = stage.settings;
  settings.stratified_ranges = stratified;
  Figures figures;
  Result<Renderer> renderer = Renderer::create(stage.scene, stage.camera, stage.primaries, settings);
  if (!renderer) return figures;
  const float size = stage.scene->bounds().diagonal();
  std::vector<double> times;
  for (std::uint32_t f = 0; f < kFrames; ++f) {
    renderer->set_camera(on_path(stage.camera, size, f));
    const Result<Frame> frame = renderer->render(f);
    if (frame) times.push_back(frame->statistics.frame_ms);
  }
  figures.p50 = quantile(times, 0.5), figures.p99 = quantile(times, 0.99);
  renderer->set_camera(stage.camera);
  Frames noisy, filtered;
  for (std::uint32_t f = 0; f < kFrames; ++f) {
    const Result<Frame> frame = renderer->render(f, {"unfiltered"});
    if (!frame) return figures;
    filtered.push_back(luminance(frame->picture));
    noisy.push_back(luminance(frame->layers.colours("unfiltered")));
  }
  figures.patch = patch_change(filtered), figures.pixel = pixel_change(filtered);
  figures.noisy = autocorrelation(noisy, mean_of(noisy));
  figures.filtered = autocorrelation(filtered, mean_of(filtered));
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
      "\n## %s\n\n| ranges | p50 ms | p99 ms | change of a patch of %ux%u | change of a pixel |\n"
      "| --- | ---: | ---: | ---: | ---: |\n",
      name.c_str(), kPatch, kPatch);
  for (const Figures* f : {&independent, &stratified}) {
    std::printf("| %s | %.0f | %.0f | %.2f %% | %.1f %% |\n", f == &independent ? "independent" : "stratified", f->p50,
                f->p99, 100 * f->patch, 100 * f->pixel);
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
    names = {"gallery", "cornell"};
    if (has_scenes()) names.insert(names.end(), {"sponza", "sibenik"});
  }
  print_page_head("Steadiness", "benchmarks/run.sh steadiness");
  std::printf(
      "\n%ux%u, %u frames each, 65,536 virtual point lights. Times: along a path of the camera round the shot's\n"
      "eye (2 %% of the scene aside and ahead). All else: camera at rest, new random ranges per frame. Changes\n"
      "are root mean squares from frame to frame, over the mean. Errors are relative, against the mean of the\n"
      "%u frames; their autocorrelation runs along rows, lags in pixels. The 8x8 grid shows where lag 8\n"
      "stands above lags 7 and 9.\n",
      kWidth, kHeight, kFrames, kFrames);
  for (const std::string& name : names) report(name);
  return 0;
}
