// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/path_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/command_line/folders.h"
#include "apps/command_line/render_plan.h"
#include "apps/command_line/shot_settings.h"
#include "base/text.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kDefaultSamples = 64;

Status apply(PathSettings& settings, const std::vector<SettingText>& entries) {
  for (const auto& [name, text] : entries) {
    if (Status status = path_setting_table().set(settings, name, text); !status) return status;
  }
  return Done{};
}

// Typed settings are tried before the shot is looked for, so that a fault is blamed on who made it.
Status read_settings(const RenderOptions& options, PathPlan& plan) {
  PathSettings typed;
  if (Status status = apply(typed, options.settings); !status) return status;
  Result<Shot> shot = find_shot(options.shot, plan.folders);
  if (!shot) return shot.error();
  plan.shot = std::move(*shot);
  const Result<ShotSettings> listed = read_shot_settings(plan.shot.settings, options.shot);
  if (!listed) return listed.error();
  for (const std::vector<SettingText>* entries : {&listed->path, &options.settings}) {
    if (Status status = apply(plan.settings, *entries); !status) return status;
  }
  if (Result<Isa> isa = choose_isa(plan.settings.isa); !isa) return isa.error();
  return Done{};
}

// "A:B", A < B.
Status read_sample_range(const std::string& text, SampleRange& range) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || !parse_number(std::string_view(text).substr(0, colon), range.first) ||
      !parse_number(std::string_view(text).substr(colon + 1), range.end) || range.first >= range.end ||
      range.end > Film::kMostSamples) {
    return Error{ErrorKind::usage, fmt::format("--sample-range must be A:B with whole numbers A < B <= {}, not '{}'",
                                               Film::kMostSamples, text)};
  }
  return Done{};
}

Status read_goal(const RenderOptions& options, PathPlan& plan) {
  const auto positive = [](const std::optional<double>& number) {
    return !number || (std::isfinite(*number) && *number > 0);
  };
  if (!positive(options.time)) return Error{ErrorKind::usage, "--time must be a number of seconds above 0"};
  if (!positive(options.noise)) return Error{ErrorKind::usage, "--noise must be a number above 0"};
  PathGoal& goal = plan.goal;
  plan.as_part = !options.sample_range.empty();
  if (plan.as_part) return read_sample_range(options.sample_range, goal.samples);
  if (options.samples && (*options.samples < 1 || *options.samples > Film::kMostSamples)) {
    return Error{ErrorKind::usage, fmt::format("--samples must be a whole number from 1 to {}", Film::kMostSamples)};
  }
  goal.seconds = options.time.value_or(goal.seconds);
  goal.noise = options.noise.value_or(0);
  const bool stops = options.time || options.noise;
  goal.samples.end = options.samples.value_or(stops ? Film::kMostSamples : kDefaultSamples);
  return Done{};
}

Status read_outputs(const RenderOptions& options, PathPlan& plan) {
  const Result<ToneCurve> curve = chosen_tone_curve(options);
  if (!curve) return curve.error();
  plan.tone_curve = *curve;
  if (options.outputs.empty()) return Error{ErrorKind::usage, "--output is required"};
  Result<OutputFiles> outputs = OutputFiles::create({options.outputs.begin(), options.outputs.end()}, {});
  if (!outputs) return outputs.error();
  plan.outputs = std::move(*outputs);
  plan.layers = options.layers;
  if (plan.as_part && !plan.layers.empty()) {
    return Error{ErrorKind::usage, "--layers: a part has none; luciole merge takes --layers"};
  }
  if (Status status = check_film_layers(plan.layers, plan.outputs); !status) return status;
  return options.statistics.empty() ? Status(Done{}) : check_writable(options.statistics);
}

Status read_checkpoint(const RenderOptions& options, PathPlan& plan) {
  if (!(options.checkpoint_every > 0) || !std::isfinite(options.checkpoint_every)) {
    return Error{ErrorKind::usage, "--checkpoint-every must be a number of seconds above 0"};
  }
  plan.checkpoint = options.checkpoint;
  plan.checkpoint_every = options.checkpoint_every;
  plan.resume = options.resume;
  if (plan.checkpoint.empty()) return Done{};
  if (plan.checkpoint.extension() != ".exr") {
    return Error{ErrorKind::usage, options.checkpoint + ": a checkpoint ends in .exr"};
  }
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(plan.checkpoint, ignored);
  for (const fs::path& name : plan.outputs.names()) {
    if (fs::weakly_canonical(name, ignored) == whole) {
      return Error{ErrorKind::usage, options.checkpoint + ": the checkpoint cannot be an output, too"};
    }
  }
  return check_writable(plan.checkpoint);
}

Status read_display(const RenderOptions& options, PathPlan& plan) {
  if (options.display.empty()) return Done{};
  Result<ViewerAddress> viewer = parse_viewer_address(options.display);
  if (!viewer) return viewer.error();
  plan.viewer = std::move(*viewer);
  return Done{};
}

// What a film, a pass and its files hold, rounded up; the scene is not known yet.
Status check_path_memory(const RenderOptions& options, PathPlan& plan) {
  constexpr double kFilm = 96, kPass = 36, kPicture = 40, kLayer = 12, kSums = 156 + 12;  // [bytes per pixel]
  const bool sums = plan.as_part || !plan.checkpoint.empty();
  const double per_pixel = kFilm + kPass + kPicture + kLayer * double(options.layers.size()) + (sums ? kSums : 0);
  const PathSettings& settings = plan.settings;
  return check_memory(double(settings.width) * settings.height * per_pixel,
                      fmt::format("--size {}x{}{}", settings.width, settings.height,
                                  plan.checkpoint.empty() ? "" : " with a checkpoint"));
}

}  // namespace

Status check_film_layers(const std::vector<std::string>& layers, const OutputFiles& outputs) {
  const std::vector<std::string>& known = Film::layer_names();
  for (const std::string& layer : layers) {
    if (std::find(known.begin(), known.end(), layer) == known.end()) {
      return Error{ErrorKind::usage, "--layers: '" + layer + "' is none of " + joined(known)};
    }
  }
  if (!layers.empty() && !outputs.any_exr()) {
    return Error{ErrorKind::usage, "--layers needs an output that ends in .exr"};
  }
  return Done{};
}

Result<PathPlan> make_path_plan(const RenderOptions& options) {
  PathPlan plan;
  plan.folders = search_folders(options.scenes);
  for (const auto read : {read_settings, read_goal, read_display, read_outputs, read_checkpoint, check_path_memory}) {
    if (Status status = read(options, plan); !status) return status.error();
  }
  return plan;
}

}  // namespace luciole
