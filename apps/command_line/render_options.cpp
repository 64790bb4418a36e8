// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/render_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/command_line/shot_settings.h"
#include "base/text.h"
#include "image/tone_curve.h"
#include "offline/film/film.h"
#include "offline/settings.h"
#include "real_time/frame.h"
#include "real_time/settings_text.h"

namespace luciole {
namespace {

constexpr const char* kExamples = R"(Examples:
  luciole render gallery -o gallery.png
  luciole render "recipe:ring?alpha=0.1" --size 640x360 --vpls 4096 -o ring.exr --layers direct,indirect
  luciole render sponza/sponza.gltf --scenes ~/scenes --camera -9,2,0/0,2.5,0/60 -o sponza.png
  luciole render gallery --accumulate 64 --jitter -o smooth.exr -o smooth.png
  luciole render gallery-walk --frames 0-179 -o frame-####.png --statistics frames.json
  luciole render gallery-walk --frames 0-179 --size 640x360 --video walk.mp4
  luciole render gallery --culling none --ranges infinite --interleave 1 --filter none -o reference.exr

  luciole render lamps --method path --samples 256 -o lamps.exr --layers albedo,normal,variance
  luciole render lamps --method path --time 30 --bounces 1 --lights tree -o lamps.png --display localhost:14158
  luciole render gallery --method path --noise 0.02 --checkpoint gallery-sums.exr --resume -o gallery.exr
  luciole render gallery --method path --sample-range 0:128 -o part-0.exr   (and 128:256 elsewhere; then luciole merge))";

// Options are shown, and refused, by these.
constexpr const char* kOfBoth = "Settings of both methods (they override the shot's)";
constexpr const char* kOfFrame = "Only with --method frame";
constexpr const char* kOfPath = "Only with --method path";

// "vpl_seed" in shots and files is "--vpl-seed" here.
std::string option_name(std::string setting) {
  std::replace(setting.begin(), setting.end(), '_', '-');
  return "--" + setting;
}

std::string help_of(const std::string& name) {
  const std::string frame = setting_help(name), path = path_setting_table().help(name);
  if (frame.empty() || path.empty() || frame == path) return frame.empty() ? path : frame;
  return "frame: " + frame + "; path: " + path;
}

// One option per setting, kept as text. Switches (jitter, direct-shadows) are flags.
void declare_setting(CLI::App& command, RenderOptions& options, const std::string& name) {
  const bool frame = is_frame_setting(name), path = is_path_setting(name);
  const char* group = frame && path ? kOfBoth : frame ? kOfFrame : kOfPath;
  if (name == "jitter" || name == "direct_shadows" || name == "vulkan_validation") {
    const auto set = [&options, name](std::int64_t) { options.settings.emplace_back(name, "true"); };
    command.add_flag_function(option_name(name), set, help_of(name))->group(group);
    return;
  }
  const auto set = [&options, name](const std::string& text) { options.settings.emplace_back(name, text); };
  command.add_option_function<std::string>(option_name(name), set, help_of(name))->group(group);
}

void declare_settings(CLI::App& command, RenderOptions& options) {
  const auto declare = [&](const std::vector<std::string>& list, auto wanted) {
    for (const std::string& name : list) {
      if (wanted(name)) declare_setting(command, options, name);
    }
  };
  declare(setting_names(), is_path_setting);
  declare(setting_names(), [](const std::string& name) { return !is_path_setting(name); });
  declare(path_setting_table().names(), [](const std::string& name) { return !is_frame_setting(name); });
  command.get_option("--delta")->excludes("--error-bound");
}

void declare_frame_options(CLI::App& command, RenderOptions& options) {
  command.add_option("--accumulate", options.accumulate, "mean of N frames with new random numbers")
      ->check(CLI::Range(1u, 1000000u))
      ->group(kOfFrame);
  command.add_option("--frames", options.frames, "A-B: frames of these indices, numbered by #### in -o")
      ->group(kOfFrame);
  command.add_option("--video", options.video, "FILE.mp4 of --frames, through the program ffmpeg")->group(kOfFrame);
}

void declare_path_options(CLI::App& command, RenderOptions& options) {
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->group(kOfPath);
  };
  CLI::Option* samples =
      add("--samples", options.samples, "stop at N samples per pixel (64, if nothing else stops it)");
  CLI::Option* time = add("--time", options.time, "stop after so many seconds of rendering");
  CLI::Option* noise = add("--noise", options.noise, "stop at this estimated relative error, for example 0.02");
  add("--sample-range", options.sample_range, "A:B: render samples A to B-1 as a part for luciole merge")
      ->excludes(samples)
      ->excludes(time)
      ->excludes(noise);
  CLI::Option* checkpoint = add("--checkpoint", options.checkpoint, "FILE.exr that keeps the samples so far");
  add("--checkpoint-every", options.checkpoint_every, "seconds between two writings (60)")->needs(checkpoint);
  command.add_flag("--resume", options.resume, "go on from the checkpoint if it exists")
      ->needs(checkpoint)
      ->group(kOfPath);
  add("--display", options.display, "HOST:PORT of the image viewer tev: live pixels");
}

}  // namespace

Verbosity verbosity_of(const RenderOptions& options) {
  if (options.quiet) return Verbosity::quiet;
  return options.verbose ? Verbosity::verbose : Verbosity::normal;
}

void declare_options(CLI::App& command, RenderOptions& options) {
  command.footer(kExamples);
  command
      .add_option("SHOT_OR_SCENE", options.shot, "a shot's name or .toml, a .gltf/.glb/.obj, or recipe:NAME?key=value")
      ->required();
  command.add_option("--method", options.method, "frame (real time) or path (path tracing)")->default_str("frame");
  command.add_option("-o,--output", options.outputs, "FILE.exr (linear, layers) or FILE.png; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--scenes", options.scenes, "folder of scenes (else $LUCIOLE_SCENES, else ./scenes)");
  command.add_option("--camera", options.camera, "x,y,z/x,y,z/degrees (eye, target, field of view), or name or index");
  command.add_option("--environment", options.environment, "sky: equirectangular FILE.exr or FILE.hdr");
  command
      .add_option(
          "--layers", options.layers,
          "layers of the .exr: " + joined(Renderer::layer_names()) + ", variance; path: " + joined(Film::layer_names()))
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--tone-curve", options.tone_curve, "of .png: pbr-neutral|linear")->default_str("pbr-neutral");
  command.add_option("--statistics", options.statistics, "write times and light counts to FILE.json");
  command.add_option("--threads", options.threads, "threads (0: all)")->check(CLI::Range(0, 1024));
  CLI::Option* quiet = command.add_flag("--quiet", options.quiet, "errors only");
  command.add_flag("--verbose", options.verbose, "tell each pass")->excludes(quiet);
  declare_settings(command, options);
  declare_frame_options(command, options);
  declare_path_options(command, options);
}

Result<Method> chosen_method(const CLI::App& command, const RenderOptions& options) {
  const std::optional<Method> method = value_named<Method>(options.method);
  if (!method) {
    return Error{ErrorKind::usage, "--method must be one of " + all_names<Method>() + ", not '" + options.method + "'"};
  }
  const std::string other = *method == Method::frame ? kOfPath : kOfFrame;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0 && option->get_group() == other) {
      return Error{ErrorKind::usage, option->get_name() + " belongs to --method " +
                                         name_of(*method == Method::frame ? Method::path : Method::frame) +
                                         ", not to --method " + name_of(*method)};
    }
  }
  return *method;
}

}  // namespace luciole
