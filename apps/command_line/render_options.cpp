// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/render_options.h"

#include <algorithm>

#include "base/text.h"
#include "image/tone_curve.h"
#include "real_time/frame.h"

namespace luciole {
namespace {

constexpr const char* kExamples = R"(Examples:
  luciole render gallery -o gallery.png
  luciole render "recipe:ring?alpha=0.1" --size 640x360 --vpls 4096 -o ring.exr --layers direct,indirect
  luciole render sponza/sponza.gltf --scenes ~/scenes --camera -9,2,0/0,2.5,0/60 -o sponza.png
  luciole render gallery --accumulate 64 --jitter -o smooth.exr -o smooth.png
  luciole render gallery --frames 1-120 -o frame-####.png --statistics frames.json
  luciole render gallery --culling none --ranges infinite --interleave 1 --filter none -o reference.exr)";

// "vpl_seed" in shots and files is "--vpl-seed" here.
std::string option_name(std::string setting) {
  std::replace(setting.begin(), setting.end(), '_', '-');
  return "--" + setting;
}

// One option per setting, kept as text. Switches (jitter, direct-shadows) are flags.
void declare_settings(CLI::App& command, RenderOptions& options) {
  for (const std::string& name : setting_names()) {
    const std::string option = option_name(name);
    if (name == "jitter" || name == "direct_shadows") {
      command
          .add_flag_function(
              option, [&options, name](std::int64_t) { options.settings.emplace_back(name, "true"); },
              setting_help(name))
          ->group("Settings (they override the shot's)");
      continue;
    }
    command
        .add_option_function<std::string>(
            option, [&options, name](const std::string& text) { options.settings.emplace_back(name, text); },
            setting_help(name))
        ->group("Settings (they override the shot's)");
  }
  command.get_option("--delta")->excludes("--error-bound");
}

}  // namespace

void declare_options(CLI::App& command, RenderOptions& options) {
  command.footer(kExamples);
  command
      .add_option("SHOT_OR_SCENE", options.shot, "a shot's name or .toml, a .gltf/.glb/.obj, or recipe:NAME?key=value")
      ->required();
  command.add_option("-o,--output", options.outputs, "FILE.exr (linear, layers) or FILE.png; may be repeated")
      ->required()
      ->allow_extra_args(false);
  command.add_option("--scenes", options.scenes, "folder of scenes (else $LUCIOLE_SCENES, else ./scenes)");
  command.add_option("--camera", options.camera, "x,y,z/x,y,z/degrees (eye, target, field of view), or name or index");
  command.add_option("--environment", options.environment, "sky: equirectangular FILE.exr or FILE.hdr");
  command.add_option("--accumulate", options.accumulate, "mean of N frames with new random numbers")
      ->check(CLI::Range(1u, 1000000u));
  command.add_option("--frames", options.frames, "A-B: frames of these indices, numbered by #### in -o");
  command
      .add_option("--layers", options.layers, "layers of the .exr: " + joined(Renderer::layer_names()) + ", variance")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--tone-curve", options.tone_curve, "of .png: pbr-neutral|linear")->default_str("pbr-neutral");
  command.add_option("--statistics", options.statistics, "write times and light counts to FILE.json");
  command.add_option("--threads", options.threads, "threads (0: all)")->check(CLI::Range(0, 1024));
  CLI::Option* quiet = command.add_flag("--quiet", options.quiet, "errors only");
  command.add_flag("--verbose", options.verbose, "tell each pass")->excludes(quiet);
  declare_settings(command, options);
}

}  // namespace luciole
