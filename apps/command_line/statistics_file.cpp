// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/statistics_file.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>

#include "apps/command_line/machine.h"
#include "apps/command_line/version.h"
#include "base/parallel.h"
#include "real_time/settings_text.h"

namespace luciole {
namespace {

using Json = nlohmann::ordered_json;

Json per_pixel(const PerPixel& count) {
  Json object = {{"total", count.total()}, {"diffuse", count.diffuse}, {"glossy", count.glossy}};
  if (count.many > 0) object["many"] = count.many;
  return object;
}

Json frame_figures(const FrameStatistics& frame) {
  Json figures;
  figures["engine"] = frame.engine;
  for (const auto& [pass, ms] : frame.passes_ms) figures["passes_ms"][pass] = ms;
  figures["frame_ms"] = frame.frame_ms;
  if (frame.scene_ms > 0) figures["scene_ms"] = frame.scene_ms;
  figures["lights"] = frame.virtual_point_lights + frame.many_lights;
  figures["virtual_point_lights"] = frame.virtual_point_lights;
  figures["many_lights"] = frame.many_lights;
  figures["culling_tests_per_pixel"] = per_pixel(frame.tests);
  figures["lights_listed_per_pixel"] = per_pixel(frame.listed);
  figures["lights_accepted_per_pixel"] = per_pixel(frame.accepted);
  figures["false_positives_per_pixel"] = per_pixel(frame.false_positives);
  figures["lights_evaluated_per_pixel"] = per_pixel(frame.evaluated);
  figures["list_length"] = {
      {"mean", frame.list_length_mean}, {"p99", frame.list_length_p99}, {"max", frame.list_length_max}};
  figures["pixels_not_finite"] = frame.pixels_not_finite;
  figures["light_pixel_evaluations_per_second"] = frame.evaluations_per_second;
  return figures;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

// The median of each figure by itself, so they need not belong to one frame. Objects are entered.
Json medians(const std::vector<Json>& frames) {
  Json result;
  for (const auto& [key, first] : frames.front().items()) {
    std::vector<Json> parts;
    std::vector<double> numbers;
    for (const Json& frame : frames) {
      const auto part = frame.find(key);
      if (part == frame.end()) continue;
      if (part->is_object()) parts.push_back(*part);
      if (part->is_number()) numbers.push_back(part->get<double>());
    }
    if (!parts.empty()) result[key] = medians(parts);
    if (numbers.empty()) continue;
    if (first.is_number_integer()) {
      result[key] = static_cast<std::uint64_t>(median(std::move(numbers)));
    } else {
      result[key] = median(std::move(numbers));
    }
  }
  return result;
}

}  // namespace

nlohmann::ordered_json typed_json(const std::string& text) {
  const Json value = Json::parse(text, nullptr, false);
  return value.is_number() || value.is_boolean() ? value : Json(text);
}

nlohmann::ordered_json machine_json(Isa wanted) {
  const Result<Isa> isa = choose_isa(wanted);
  return {{"instruction_set", isa ? to_string(*isa) : "none"},
          {"threads", thread_count()},
          {"processor", processor_name()},
          {"version", kVersion},
          {"commit", kCommit}};
}

std::string statistics_json(const RunStatistics& run) {
  std::vector<Json> frames;
  for (const auto& [index, frame] : run.frames) frames.push_back(frame_figures(frame));
  Json object = frames.size() == 1 ? frames.front() : medians(frames);
  object["load_ms"] = run.load_ms;
  object["bvh_ms"] = run.bvh_ms;
  object["peak_memory_bytes"] = peak_memory_bytes();
  object["shot"] = run.shot;
  object["primary_lights"] = run.primary_lights;
  for (const auto& [name, text] : settings_as_text(run.settings)) object["settings"][name] = typed_json(text);
  if (!run.settings.device.empty()) object["device"] = run.settings.device;
  object["seed"] = run.settings.seed;
  object.update(machine_json(run.settings.isa));
  object["notes"] = run.notes;
  if (frames.size() > 1) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      Json entry = {{"frame", run.frames[i].first}};
      entry.update(frames[i]);
      object["frames"].push_back(std::move(entry));
    }
  }
  // Names come from files: whatever is not UTF-8 in them must not stop the writing.
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace luciole
