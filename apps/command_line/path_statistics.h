// SPDX-License-Identifier: Apache-2.0
// The statistics of a path tracing run as JSON: one object; memory in bytes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "offline/film/film.h"
#include "offline/render.h"
#include "offline/settings.h"

namespace luciole {

struct PathRunStatistics {
  std::string shot;
  PathSettings settings;  // as chosen
  double load_ms = 0, bvh_ms = 0, prepare_ms = 0;
  double render_seconds = 0;  // of this process, in passes
  std::uint64_t passes = 0;   // of this process; a resumed film has more samples
  PathStatistics counts;      // of this process
  std::uint64_t lights = 0, light_bytes = 0;
  std::vector<std::string> notes;
};

std::string path_statistics_json(const PathRunStatistics& run, const Film& film);

}  // namespace luciole
