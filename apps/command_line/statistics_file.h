// SPDX-License-Identifier: Apache-2.0
// What a run of frames cost, as JSON: one object; times in milliseconds, memory in bytes.
#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "real_time/frame.h"

namespace luciole {

struct RunStatistics {
  std::string shot;
  Settings settings;
  double load_ms = 0, bvh_ms = 0;
  std::uint64_t primary_lights = 0;
  std::vector<std::string> notes;  // defaults that were filled in, and warnings of the scene
  std::vector<std::pair<std::uint64_t, FrameStatistics>> frames;  // frame index, in the order of rendering; not empty
};

// One frame's figures stand at the top; of several frames the top holds the medians, and `frames` all of them.
// Counts per pixel are {total, diffuse, glossy}; means over pixels that show a surface.
std::string statistics_json(const RunStatistics& run);

// A setting's text as JSON's own number or switch, where it is one.
nlohmann::ordered_json typed_json(const std::string& text);

// Instruction set, threads, processor, version and commit.
nlohmann::ordered_json machine_json(Isa wanted);

}  // namespace luciole
