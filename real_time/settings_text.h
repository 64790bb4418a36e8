// SPDX-License-Identifier: Apache-2.0
// Settings as text: one table serves the command line, the [settings] of shots, the statistics and the metadata of
// pictures, so that a name means the same everywhere.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/setting_table.h"
#include "real_time/settings.h"

namespace luciole {

// Names in the order of `Settings`: size, vpls, bounds, tile_test, ... Words are joined by underscores.
const std::vector<std::string>& setting_names();

// One line about a setting, with its values, for --help. Empty for an unknown name.
std::string setting_help(std::string_view name);

// Changes one setting. The sentence of a failure names the setting as it was passed and says what would be valid.
//   text   "1280x720", "65536", "tight", "0.001", "true", ...; "error_bound" sets delta = 2 pi E ([TH16] Eq. 6)
Status set_setting(Settings& settings, std::string_view name, std::string_view text);

// The defaults, changed by a shot's entries and then by the command line's. Within one list delta and error_bound
// exclude each other. A tile test that nobody names follows the bounds: `tight` for tight ones, else `paper`.
Result<Settings> settings_from(const std::vector<SettingText>& shot, const std::vector<SettingText>& command_line);

// All settings, in the order of setting_names(), without error_bound (which is delta in other words).
std::vector<SettingText> settings_as_text(const Settings& settings);

}  // namespace luciole
