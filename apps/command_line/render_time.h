// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>

namespace luciole {

// What `luciole render --statistics NAME.json` wrote beside the picture NAME.exr: "959 ms a frame" or "30 s". Pictures
// themselves carry no times, so that equal pictures are equal files. Empty without such a file, or if it is another's.
std::string render_time_beside(const std::filesystem::path& picture);

}  // namespace luciole
