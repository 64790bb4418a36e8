// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/shot_settings.h"

#include <algorithm>

#include "offline/settings.h"
#include "real_time/settings_text.h"

namespace luciole {

bool is_frame_setting(const std::string& name) {
  const std::vector<std::string>& names = setting_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_path_setting(const std::string& name) { return path_setting_table().has(name); }

Result<ShotSettings> read_shot_settings(const std::vector<SettingText>& listed, const std::string& shot) {
  ShotSettings settings;
  PathSettings path;
  Status status = Done{};
  for (const SettingText& entry : listed) {
    const bool for_path = is_path_setting(entry.first), for_frame = is_frame_setting(entry.first);
    if (for_frame || !for_path) settings.frame.push_back(entry);  // unknown names are refused there
    if (!for_path || entry.first == "error_bound" || entry.first == "range_samples") continue;
    settings.path.push_back(entry);
    if (status) status = path_setting_table().set(path, entry.first, entry.second);
  }
  if (Result<Settings> frame = settings_from(settings.frame, {}); !frame) status = frame.error();
  if (!status) return Error{ErrorKind::bad_scene, shot + ": [settings] " + status.error().message};
  return settings;
}

}  // namespace luciole
