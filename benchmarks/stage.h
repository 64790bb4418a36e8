// SPDX-License-Identifier: Apache-2.0
// What the benchmarks share: shots made ready, medians, and how fast the processor's clock runs.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ray_tracing/ray_scene.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/settings_text.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"
#include "shot/find_shot.h"

namespace luciole {

// The shots of the source tree, and the folder of scenes that $LUCIOLE_SCENES names.
SearchFolders benchmark_folders();
bool has_scenes();

// A shot, opened.
struct Stage {
  std::string name;
  Settings settings;  // the instruction set is resolved
  std::shared_ptr<const Scene> scene;
  Camera camera;
  PrimaryLights primaries;
};

// Ends the program with a sentence if the shot cannot be opened.
//   overrides   win over the shot's settings
Stage open_stage(const std::string& name, const std::vector<SettingText>& overrides);

// With the shot's primary lights among the scene's own, where the path tracer looks for them.
Stage with_primaries(Stage stage);

// Geometry buffer and virtual point lights of a stage.
struct PreparedStage : Stage {
  GeometryBuffer geometry;
  VirtualPointLights lights;
};
PreparedStage prepare_stage(const std::string& name, const std::vector<SettingText>& overrides);

double median(std::vector<double> values);
double quantile(std::vector<double> values, double q);  // 0 <= q <= 1

double now_seconds();

// Wall time of one call [s].
template <class Work>
double seconds_of(const Work& work) {
  const double start = now_seconds();
  work();
  return now_seconds() - start;
}

// The clock [Hz] of the core under us, from additions that wait for each other: one per cycle. About 20 ms.
double clock_hz();

// "2 cores, AVX-512, 2.1 GHz"
std::string processor_class();

// Title, the command that makes the page, and the processor.
void print_page_head(const char* title, const char* command);

}  // namespace luciole
