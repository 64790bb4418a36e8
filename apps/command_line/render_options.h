// SPDX-License-Identifier: Apache-2.0
// What `luciole render` was asked for, as typed. Values of settings are checked with those of the shot.
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "real_time/settings_text.h"

namespace luciole {

struct RenderOptions {
  std::string shot;
  std::vector<std::string> outputs;
  std::vector<SettingText> settings;  // in the order of the command line
  std::vector<std::string> layers;
  std::string statistics, scenes, camera, environment, frames;  // empty: not asked for
  std::string tone_curve;
  std::uint32_t accumulate = 1;
  int threads = 0;  // 0: all
  bool quiet = false, verbose = false;
};

// Declares the options; `options` must outlive the parsing.
void declare_options(CLI::App& command, RenderOptions& options);

}  // namespace luciole
