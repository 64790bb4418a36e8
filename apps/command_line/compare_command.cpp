// SPDX-License-Identifier: Apache-2.0
// luciole compare: how far a picture is from a reference, and where.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command_line/commands.h"
#include "apps/command_line/output_files.h"
#include "image/exr.h"
#include "image/false_colour.h"
#include "image/metrics.h"
#include "image/png.h"

namespace luciole {
namespace {

constexpr const char* kExamples = R"(Examples:
  luciole compare result.exr reference.exr
  luciole compare result.exr reference.exr --exposure 4 --json
  luciole compare result.exr reference.exr --error-map error.png --flip-map flip.png)";

struct CompareOptions {
  std::string picture, reference;
  std::string error_map, flip_map;  // empty: not wanted
  float exposure = 1;
  bool json = false;
};

// JSON has no infinity: null stands for a ratio to a black reference.
nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

// The names of maps are refused before pictures are read.
Status check_maps(const CompareOptions& options) {
  for (const std::string& name : {options.error_map, options.flip_map}) {
    if (name.empty()) continue;
    if (std::filesystem::path(name).extension() != ".png") {
      return Error{ErrorKind::usage, name + ": maps end in .png"};
    }
    if (Status status = check_writable(name); !status) return status;
  }
  if (!options.error_map.empty() && options.error_map == options.flip_map) {
    return Error{ErrorKind::usage, options.error_map + ": named twice as output"};
  }
  return Done{};
}

Status write_maps(const CompareOptions& options, const Image& picture, const DifferenceMaps& maps) {
  const auto write = [&](const std::string& name, const std::vector<Vec3>& colours) -> Status {
    return name.empty() ? Status(Done{}) : write_png(colours, picture.width, picture.height, name);
  };
  if (Status status = write(options.error_map, error_colours(maps.relative_error)); !status) return status;
  return write(options.flip_map, flip_colours(maps.flip));
}

void print_table(const CompareOptions& options, const nlohmann::ordered_json& figures) {
  std::string text;
  for (const auto& [name, value] : figures.items()) {
    text += fmt::format("{:<19} {:.6g}\n", name, value.is_null() ? HUGE_VAL : value.get<double>());
  }
  if (!options.error_map.empty()) {
    text += fmt::format("error map           relative error, logarithmic from {:g} (black) to {:g} (pale yellow)\n",
                        kLowestError, kHighestError);
  }
  if (!options.flip_map.empty()) text += "FLIP map            linear from 0 (black) to 1 (pale yellow)\n";
  std::fputs(text.c_str(), stdout);
}

Result<int> run_compare(const CompareOptions& options) {
  if (Status status = check_maps(options); !status) return status.error();
  const Result<Image> picture = read_exr(options.picture);
  if (!picture) return picture.error();
  const Result<Image> reference = read_exr(options.reference);
  if (!reference) return reference.error();
  ComparisonSettings settings;
  settings.exposure = options.exposure;
  const Result<MappedComparison> compared = compare_with_maps(*picture, *reference, settings);
  if (!compared) return compared.error();
  if (Status status = write_maps(options, *picture, compared->maps); !status) return status.error();
  const Comparison& figures = compared->figures;
  nlohmann::ordered_json object;
  object["rmse"] = finite_or_null(figures.rmse);
  object["display_rmse"] = finite_or_null(figures.display_rmse);
  object["relmse"] = finite_or_null(figures.relmse);
  object["flip"] = finite_or_null(figures.flip);
  object["largest_difference"] = finite_or_null(figures.largest_difference);
  object["mean_ratio"] = finite_or_null(figures.mean_ratio);
  if (options.json) {
    std::fputs((object.dump(2) + "\n").c_str(), stdout);
  } else {
    print_table(options, object);
  }
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = program.add_subcommand("compare", "Compare a picture with a reference");
  command->footer(kExamples);
  command->add_option("PICTURE", options->picture, "OpenEXR file")->required();
  command->add_option("REFERENCE", options->reference, "OpenEXR file of the same size")->required();
  command->add_option("--exposure", options->exposure, "display value per radiance, for FLIP and display_rmse")
      ->check(CLI::PositiveNumber);
  command->add_option("--error-map", options->error_map, "FILE.png: relative error per pixel in false colour");
  command->add_option("--flip-map", options->flip_map, "FILE.png: FLIP per pixel in false colour");
  command->add_flag("--json", options->json, "print a JSON object");
  command->callback([options, &chosen] { chosen = [options] { return run_compare(*options); }; });
}

}  // namespace luciole
