// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/render_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/command_line/folders.h"
#include "apps/command_line/machine.h"
#include "apps/command_line/shot_settings.h"
#include "base/text.h"
#include "real_time/frame.h"
#include "real_time/settings_text.h"

namespace luciole {
namespace {

// Roughly what a frame holds besides the scene, which is not read yet. Measured in cornell and Sponza up to 3840x2160
// and 1,048,576 lights: 160 bytes per pixel, 340 to 480 per light, 12 per pixel and layer.
Status check_frame_memory(const Settings& settings, const RenderOptions& options) {
  constexpr double kBytesPerPixel = 180, kBytesPerLayer = 16, kBytesPerVpl = 420, kBytesOfHistory = 190;
  const double pixels = double(settings.width) * settings.height;
  const double accumulated = options.accumulate > 1 ? double(options.layers.size() + 2) * 24 : 0;
  const double history = settings.temporal > 1 ? kBytesOfHistory : 0;
  const double bytes =
      pixels * (kBytesPerPixel + history + kBytesPerLayer * double(options.layers.size()) + accumulated) +
      kBytesPerVpl * settings.vpls;
  return check_memory(bytes, fmt::format("--size {}x{} with {} VPLs", settings.width, settings.height, settings.vpls));
}

Status read_layers(const RenderOptions& options, RenderPlan& plan) {
  const std::vector<std::string>& known = Renderer::layer_names();
  for (const std::string& layer : options.layers) {
    if (layer == "variance") {
      plan.variance = true;
    } else if (std::find(known.begin(), known.end(), layer) != known.end()) {
      plan.layers.push_back(layer);
    } else {
      return Error{ErrorKind::usage, "--layers: '" + layer + "' is none of " + joined(known) + ", variance"};
    }
  }
  if (!options.layers.empty() && !plan.outputs.any_exr()) {
    return Error{ErrorKind::usage, "--layers needs an output that ends in .exr"};
  }
  if (plan.variance && options.accumulate < 2) {
    return Error{ErrorKind::usage, "the layer variance needs --accumulate of at least 2"};
  }
  return Done{};
}

// Shot and command line together. Each is also tried alone, so that a fault is blamed on who made it.
Status read_settings(const RenderOptions& options, RenderPlan& plan) {
  if (Result<Settings> typed = settings_from({}, options.settings); !typed) return typed.error();
  Result<Shot> shot = find_shot(options.shot, plan.folders);
  if (!shot) return shot.error();
  plan.shot = std::move(*shot);
  const Result<ShotSettings> listed = read_shot_settings(plan.shot.settings, options.shot);
  if (!listed) return listed.error();
  Result<Settings> settings = settings_from(listed->frame, options.settings);
  if (!settings) return settings.error();
  plan.settings = *settings;
  if (options.accumulate > 1 && plan.settings.temporal > 1) {
    return Error{ErrorKind::usage, "--accumulate and --temporal both average over frames: give one of them"};
  }
  if (Status able = Renderer::check(plan.settings); !able) return able;
  return check_frame_memory(plan.settings, options);
}

Status read_outputs(const RenderOptions& options, RenderPlan& plan) {
  const Result<ToneCurve> curve = chosen_tone_curve(options);
  if (!curve) return curve.error();
  plan.tone_curve = *curve;
  if (!options.frames.empty()) {
    const Result<FrameRange> frames = parse_frame_range(options.frames);
    if (!frames) return frames.error();
    plan.frames = *frames;
  }
  Result<OutputFiles> outputs = OutputFiles::create({options.outputs.begin(), options.outputs.end()}, plan.frames);
  if (!outputs) return outputs.error();
  plan.outputs = std::move(*outputs);
  if (options.outputs.empty() && options.video.empty()) {
    return Error{ErrorKind::usage, "--output or --video is required"};
  }
  return options.statistics.empty() ? Status(Done{}) : check_writable(options.statistics);
}

Status read_video(const RenderOptions& options, RenderPlan& plan) {
  if (options.video.empty()) return Done{};
  if (!plan.frames.numbered) return Error{ErrorKind::usage, "--video needs --frames A-B"};
  plan.video = VideoFormat{options.video, plan.settings.width, plan.settings.height, plan.shot.frames_per_second};
  return check_video(*plan.video);
}

}  // namespace

Result<ToneCurve> chosen_tone_curve(const RenderOptions& options) {
  if (options.tone_curve.empty()) return ToneCurve::pbr_neutral;
  const std::optional<ToneCurve> curve = tone_curve_by_name(options.tone_curve);
  if (!curve) return Error{ErrorKind::usage, "--tone-curve must be pbr-neutral or linear"};
  return *curve;
}

Status check_memory(double bytes, const std::string& what) {
  const double memory = static_cast<double>(physical_memory_bytes());
  if (memory <= 0 || bytes <= memory) return Done{};
  constexpr double kGib = 1024.0 * 1024 * 1024;
  return Error{ErrorKind::usage, fmt::format("{} needs about {:.0f} GiB of memory and this machine has {:.0f}", what,
                                             bytes / kGib, memory / kGib)};
}

Result<RenderPlan> make_plan(const RenderOptions& options) {
  RenderPlan plan;
  plan.folders = search_folders(options.scenes);
  for (const auto read : {read_settings, read_outputs, read_layers, read_video}) {
    if (Status status = read(options, plan); !status) return status.error();
  }
  return plan;
}

}  // namespace luciole
