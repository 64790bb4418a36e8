// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/stage.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "base/parallel.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "shot/open_shot.h"

namespace luciole {
namespace {

template <class T>
T value_or_exit(Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(1);
  }
  return std::move(*result);
}

}  // namespace

bool has_scenes() { return std::getenv("LUCIOLE_SCENES") != nullptr; }

SearchFolders benchmark_folders() {
  SearchFolders folders;
  folders.shots = {LUCIOLE_SOURCE_DIR "/shots"};
  if (has_scenes()) folders.scenes = {std::getenv("LUCIOLE_SCENES")};
  return folders;
}

Stage open_stage(const std::string& name, const std::vector<SettingText>& overrides) {
  const SearchFolders folders = benchmark_folders();
  const Shot shot = value_or_exit(find_shot(name, folders));
  OpenedShot opened = value_or_exit(open_shot(shot, folders));
  Stage stage;
  stage.name = name;
  stage.settings = value_or_exit(settings_from(shot.settings, overrides));
  stage.settings.isa = value_or_exit(choose_isa(stage.settings.isa));
  stage.primaries = opened.primary.empty() ? opened.scene.lights : opened.primary;
  stage.camera = opened.camera;
  stage.scene = std::make_shared<const Scene>(std::move(opened.scene));
  return stage;
}

Stage with_primaries(Stage stage) {
  auto scene = std::make_shared<Scene>(*stage.scene);
  for (const PunctualLight& light : stage.primaries) {
    const auto same = [&](const PunctualLight& other) {
      return length(other.position - light.position) == 0 && length(other.intensity - light.intensity) == 0;
    };
    if (std::none_of(scene->lights.begin(), scene->lights.end(), same)) scene->lights.push_back(light);
  }
  stage.scene = scene;
  return stage;
}

PreparedStage prepare_stage(const std::string& name, const std::vector<SettingText>& overrides) {
  PreparedStage stage;
  static_cast<Stage&>(stage) = open_stage(name, overrides);
  const Settings& settings = stage.settings;
  const RayScene rays = value_or_exit(RayScene::create(stage.scene));
  render_geometry_buffer({rays, stage.camera, settings.width, settings.height}, stage.geometry);
  stage.lights = make_virtual_point_lights(rays, stage.primaries, settings, 0);
  return stage;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double clock_hz() {
  constexpr int kRounds = 200'000, kAdditions = 8;
  double best = 1e30;  // a slower round was interrupted
  for (int attempt = 0; attempt < 20; ++attempt) {
    std::uint64_t sum = 0;
    best = std::min(best, seconds_of([&] {
                      for (int i = 0; i < kRounds; ++i) {
                        // Of a register: additions of constants are folded into each other by some processors.
                        asm volatile(
                            "add %1, %0\n\tadd %1, %0\n\tadd %1, %0\n\tadd %1, %0\n\t"
                            "add %1, %0\n\tadd %1, %0\n\tadd %1, %0\n\tadd %1, %0"
                            : "+r"(sum)
                            : "r"(std::uint64_t(i)));
                      }
                    }));
  }
  return double(kRounds) * kAdditions / best;
}

std::string processor_class() {
  const bool avx512 = choose_isa(Isa::avx512).has_value(), avx2 = choose_isa(Isa::avx2).has_value();
  char text[80];
  std::snprintf(text, sizeof(text), "%d cores, %s, %.1f GHz", thread_count(),
                avx512 ? "AVX-512" : (avx2 ? "AVX2" : "no AVX2"), clock_hz() * 1e-9);
  return text;
}

void print_page_head(const char* title, const char* command) {
  std::printf("# %s\n\nRemake: `%s`. Processor: %s.\n", title, command, processor_class().c_str());
}

}  // namespace luciole
