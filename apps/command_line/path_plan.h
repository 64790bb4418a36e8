// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/command_line/output_files.h"
#include "apps/command_line/render_options.h"
#include "base/result.h"
#include "image/tone_curve.h"
#include "offline/display/live_display.h"
#include "offline/film/film.h"
#include "offline/settings.h"
#include "shot/find_shot.h"

namespace luciole {

// When to stop: at whatever is reached first, after one sample at least.
struct PathGoal {
  SampleRange samples{0, Film::kMostSamples};
  double seconds = std::numeric_limits<double>::infinity();  // of rendering
  double noise = 0;                                          // estimated relative error; 0: does not stop
};

// A run of the path tracer whose every part was found good, before anything heavy happened.
struct PathPlan {
  Shot shot;
  SearchFolders folders;
  PathSettings settings;
  PathGoal goal;
  bool as_part = false;  // .exr outputs carry the sums, for luciole merge
  OutputFiles outputs;
  ToneCurve tone_curve = ToneCurve::pbr_neutral;
  std::vector<std::string> layers;
  std::filesystem::path checkpoint;  // empty: none
  double checkpoint_every = 60;      // [s]
  bool resume = false;
  std::optional<ViewerAddress> viewer;
};

// Checks all that can be checked before a scene is loaded: shot, settings, goal, memory, outputs, layers, checkpoint.
Result<PathPlan> make_path_plan(const RenderOptions& options);

// The layers that a film can give, and whether an output takes them.
Status check_film_layers(const std::vector<std::string>& layers, const OutputFiles& outputs);

}  // namespace luciole
