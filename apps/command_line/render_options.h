// SPDX-License-Identifier: Apache-2.0
// What `luciole render` was asked for, as typed. Values of settings are checked with those of the shot.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/command_line/progress.h"
#include "base/setting_table.h"

namespace CLI {
class App;  // the header takes seconds to compile
}

namespace luciole {

enum class Method : std::uint8_t {
  frame,  // real_time/: one frame, or several
  path    // offline/: progressive path tracing
};

constexpr NameTable<Method, 2> names(Method) { return {{{Method::frame, "frame"}, {Method::path, "path"}}}; }

struct RenderOptions {
  std::string shot;
  std::string method = "frame";
  std::vector<std::string> outputs;
  std::vector<SettingText> settings;  // in the order of the command line
  std::vector<std::string> layers;
  std::string statistics, scenes, camera, environment;  // empty: not asked for
  std::string tone_curve;
  int threads = 0;  // 0: all
  bool quiet = false, verbose = false;
  // --method frame
  std::string frames, video;
  std::uint32_t accumulate = 1;
  // --method path
  std::optional<std::uint64_t> samples;
  std::optional<double> time, noise;  // [s], relative error
  std::string sample_range, checkpoint, display;
  double checkpoint_every = 60;  // [s]
  bool resume = false;
};

Verbosity verbosity_of(const RenderOptions& options);

// Declares the options; `options` must outlive the parsing.
void declare_options(CLI::App& command, RenderOptions& options);

// The method that was asked for. Refused: an unknown one, and options of the other one.
Result<Method> chosen_method(const CLI::App& command, const RenderOptions& options);

}  // namespace luciole
