// SPDX-License-Identifier: Apache-2.0
// Ways to cull and shade on a Vulkan device, each checked against the light of the engine's kernel, and timed.
//   shading_variants_benchmark DEVICE WIDTHxHEIGHT VPLS FRAMES SCENE ...
//     DEVICE  its number or a part of its name; '': the best there is
// Prints Markdown.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "benchmarks/shading_variants/measure.h"
#include "real_time/shading/tile_shading_pass.h"

namespace luciole {
namespace {

constexpr const char* kKindNames[] = {"diffuse", "glossy", "many", "all"};
constexpr double kWorthIt = 0.9;  // of the first's time: what more text in the engine must save at least

// Size, count of lights, rounds.
constexpr const char* kWhatIsMeasured =
    R"(%s pixels, %s virtual point lights. Medians of %s rounds by timestamps of the device; each round runs one variant after
the other, so that whatever slows the machine down slows all. The ratio is the median over the rounds of the time to
that of the first in the same round. Light: whether the sums per pixel have the bits of the first, else their mean square
error, relative to the mean square, and at how many pixels another number of lights was accepted.
)";

constexpr const char* kOnSoftware = R"(
**Software Vulkan says little of GPUs.** It runs the subgroups of a workgroup in turn on one core, keeps shared memory
in the same cache as all else, has no latency to hide by more workgroups, reads memory lane by lane, and computes half
precision by way of float.
)";

void print_head(const gpu::DeviceDescription& device, int argc, char** argv) {
  std::printf("# Ways to cull and shade on %s\n\nRemake: `build/benchmarks/shading_variants_benchmark",
              device.name.c_str());
  for (int i = 1; i < argc; ++i) std::printf(argv[i][0] == '\0' ? " ''%s" : " %s", argv[i]);
  std::printf("` (`benchmarks/gpu.sh` runs it too). Driver: %s; subgroups of %u.\n\n", device.driver.c_str(),
              device.subgroup_size);
  std::printf(kWhatIsMeasured, argv[2], argv[3], argv[4]);
  if (device.kind == gpu::DeviceKind::cpu) std::printf("%s", kOnSoftware);
}

// How much of their tiles the sub-regions fill: at the edges large tiles waste more.
void print_waste(const Settings& settings) {
  std::printf("Sub-regions fill");
  for (const std::uint32_t tile : {16u, 8u}) {
    const std::uint32_t side = tile * settings.interleave;
    const double columns = (settings.width + side - 1) / side, rows = (settings.height + side - 1) / side;
    const double pixels = columns * rows * side * side;
    std::printf("%s %.0f %% of tiles of %ux%u", tile == 8 ? " and" : "",
                100.0 * settings.width * settings.height / pixels, tile, tile);
  }
  std::printf(" pixels.\n");
}

void print_variants(const SceneTimes& scene) {
  std::printf("\n## What was tried\n\n");
  for (const VariantTimes& variant : scene.variants) {
    std::printf("- **%s**: %s\n", variant.name.c_str(), variant.what.c_str());
  }
  for (const auto& [name, why] : scene.left_out) {
    std::printf("- **%s**: not tried, as %s\n", name.c_str(), why.c_str());
  }
}

void print_light(const std::vector<Comparison>& of_kinds) {
  double error = 0;
  std::size_t others = 0;
  bool same = true;
  for (const Comparison& c : of_kinds) {
    same = same && c.same_bits;
    error = std::max(error, c.relative_mse), others += c.other_lights;
  }
  if (same) {
    std::printf(" same bits |\n");
  } else {
    std::printf(" %.1e, %zu |\n", error, others);
  }
}

void print_scene(const SceneTimes& scene) {
  std::vector<std::size_t> columns(scene.kinds.begin(), scene.kinds.end());
  columns.push_back(kLightKinds);
  std::printf("\n## `%s`\n\n", scene.scene.c_str());
  print_waste(scene.settings);
  std::printf("\n| variant |");
  for (const std::size_t k : columns) std::printf(" %s [ms] | ratio |", kKindNames[k]);
  std::printf(" light |\n| --- |");
  for (std::size_t i = 0; i < columns.size(); ++i) std::printf(" ---: | ---: |");
  std::printf(" --- |\n");
  for (const VariantTimes& variant : scene.variants) {
    std::printf("| %s |", variant.name.c_str());
    for (const std::size_t k : columns) {
      if (variant.ms[k] > 0) {
        std::printf(" %.3g | %.2f |", variant.ms[k], variant.to_first[k]);
      } else {
        std::printf(" | |");
      }
    }
    print_light(variant.light);
  }
  if (scene.error_of_float > 0) {
    std::printf("\nMedian relative error of virtual lights against double precision: %.1e with lights by pixel",
                scene.error_of_float);
    if (scene.error_of_half > 0) std::printf(", %.1e with half precision", scene.error_of_half);
    std::printf(".\n");
  }
}

// Which variant takes the least of the first's time, by the geometric mean over the scenes, and which are worth it.
void print_choice(const gpu::DeviceDescription& device, const std::vector<SceneTimes>& scenes) {
  std::string best, worth;
  double least = 1;
  for (std::size_t v = 1; v < scenes.front().variants.size(); ++v) {
    const std::string& name = scenes.front().variants[v].name;
    double product = 1, largest = 0;
    for (const SceneTimes& scene : scenes) {
      for (const VariantTimes& variant : scene.variants) {
        if (variant.name != name) continue;
        product *= variant.to_first[kLightKinds], largest = std::max(largest, variant.to_first[kLightKinds]);
      }
    }
    const double mean = std::pow(product, 1.0 / double(scenes.size()));
    if (mean < least) least = mean, best = name;
    if (largest < kWorthIt) worth += (worth.empty() ? "**" : ", **") + name + "**";
  }
  std::printf("\n## What is chosen\n\nOn this device the engine takes **lights by %s**.\n",
              faster_light_reads(device) == LightReads::by_pixel ? "pixel" : "subgroup");
  if (best.empty()) {
    std::printf("Nothing that was tried is faster than lights by pixel over all scenes.\n");
    return;
  }
  std::printf("The fastest over all scenes is **%s**, %.2f of the time of lights by pixel (geometric mean).\n",
              best.c_str(), least);
  if (worth.empty()) {
    std::printf("No variant saves more than a tenth in every scene.\n");
  } else {
    std::printf("More than a tenth in every scene is saved by %s.\n", worth.c_str());
  }
}

template <class T>
T value_or_exit(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "shading_variants_benchmark: %s\n", result.error().message.c_str());
  std::exit(static_cast<int>(result.error().kind));
}

}  // namespace
}  // namespace luciole

int main(int argc, char** argv) {
  using namespace luciole;
  const int frames = argc > 4 ? std::atoi(argv[4]) : 0;
  if (argc < 6 || frames < 1) {
    std::fprintf(stderr, "usage: shading_variants_benchmark DEVICE WIDTHxHEIGHT VPLS FRAMES SCENE ...\n");
    return 2;
  }
  gpu::DeviceRequest request;
  request.wanted = argv[1];
  const auto device = value_or_exit(gpu::Device::create(request));
  const std::vector<SettingText> settings = {
      {"size", argv[2]}, {"vpls", argv[3]}, {"culling", "tiled"}, {"bounds", "tight"}, {"tile_test", "tight"}};
  std::vector<SceneTimes> scenes;
  for (int i = 5; i < argc; ++i) {
    scenes.push_back(
        value_or_exit(measure(*device, prepare_stage(argv[i], settings), static_cast<std::uint32_t>(frames))));
  }
  print_head(device->description(), argc, argv);
  print_variants(scenes.front());
  for (const SceneTimes& scene : scenes) print_scene(scene);
  print_choice(device->description(), scenes);
}
