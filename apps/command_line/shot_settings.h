// SPDX-License-Identifier: Apache-2.0
// A shot's [settings] serve both methods of rendering: each takes what it knows.
#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "base/setting_table.h"

namespace luciole {

struct ShotSettings {
  std::vector<SettingText> frame, path;
};

// Names that both methods know go to both, but error_bound and range_samples: there a shot means the real-time frame,
// which its delta was chosen for. All are checked, whichever method is to be run.
//   shot   its name, for the sentence of a refusal
Result<ShotSettings> read_shot_settings(const std::vector<SettingText>& listed, const std::string& shot);

// Whether the word names a setting of that method on the command line.
bool is_frame_setting(const std::string& name);
bool is_path_setting(const std::string& name);

}  // namespace luciole
