// SPDX-License-Identifier: Apache-2.0
// What a run of frames cost, as JSON: one object; times in milliseconds, memory in bytes.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "real_time/frame.h"

namespace luciole {

struct RunStatistics {
  std::string shot;
  Settings settings;
  int threads = 0;
  double load_ms = 0, bvh_ms = 0;
  std::uint64_t primary_lights = 0;
  std::vector<std::string> notes;  // defaults that were filled in, and warnings of the scene
  std::vector<std::pair<std::uint64_t, FrameStatistics>> frames;  // frame index, in the order of rendering; not empty
};

// One frame's figures stand at the top; of several frames the top holds the medians, and `frames` all of them.
// Counts per pixel are {total, diffuse, glossy}; means over pixels that show a surface.
std::string statistics_json(const RunStatistics& run);

Status write_text(const std::string& text, const std::filesystem::path& path);

}  // namespace luciole
