// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/path_statistics.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/command_line/statistics_file.h"
#include "base/parallel.h"

namespace luciole {

std::string path_statistics_json(const PathRunStatistics& run, const Film& film) {
  using Json = nlohmann::ordered_json;
  const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0.0; };
  const double error = film.relative_error();
  Json object;
  object["method"] = "path";
  object["samples_per_pixel"] = film.range().count();
  object["sample_range"] = {film.range().first, film.range().end};
  object["samples_rendered"] = run.passes;
  object["render_seconds"] = run.render_seconds;
  object["rays_per_second"] = ratio(double(run.counts.rays), run.render_seconds);
  object["paths_per_second"] = ratio(double(run.counts.paths), run.render_seconds);
  object["rays"] = run.counts.rays;
  object["paths"] = run.counts.paths;
  object["lights"] = run.lights;
  object["light_bytes"] = run.light_bytes;
  object["light_choices"] = run.counts.light_choices;
  object["candidates_per_choice"] = ratio(double(run.counts.candidates), double(run.counts.light_choices));
  object["error_estimate"] = std::isfinite(error) ? Json(error) : Json(nullptr);
  object["samples_cut"] = film.saturated();
  object["load_ms"] = run.load_ms;
  object["bvh_ms"] = run.bvh_ms;
  object["prepare_ms"] = run.prepare_ms;
  object["peak_memory_bytes"] = peak_memory_bytes();
  object["shot"] = run.shot;
  for (const auto& [name, text] : path_setting_table().as_text(run.settings)) {
    object["settings"][name] = typed_json(text);
  }
  object["seed"] = run.settings.seed;
  object.update(machine_json(run.settings.isa));
  object["notes"] = run.notes;
  // Names come from files: whatever is not UTF-8 in them must not stop the writing.
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace luciole
