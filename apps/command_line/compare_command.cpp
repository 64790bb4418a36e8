// SPDX-License-Identifier: Apache-2.0
// luciole compare: how far a picture is from a reference.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command_line/commands.h"
#include "image/exr.h"
#include "image/metrics.h"

namespace luciole {
namespace {

constexpr const char* kExamples = R"(Examples:
  luciole compare result.exr reference.exr
  luciole compare result.exr reference.exr --exposure 4 --json)";

struct CompareOptions {
  std::string picture, reference;
  float exposure = 1;
  bool json = false;
};

// JSON has no infinity: null stands for a ratio to a black reference.
nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

Result<int> run_compare(const CompareOptions& options) {
  const Result<Image> picture = read_exr(options.picture);
  if (!picture) return picture.error();
  const Result<Image> reference = read_exr(options.reference);
  if (!reference) return reference.error();
  ComparisonSettings settings;
  settings.exposure = options.exposure;
  const Result<Comparison> compared = compare(*picture, *reference, settings);
  if (!compared) return compared.error();
  const std::pair<const char*, double> figures[] = {{"rmse", compared->rmse},
                                                    {"relmse", compared->relmse},
                                                    {"flip", compared->flip},
                                                    {"largest_difference", compared->largest_difference},
                                                    {"mean_ratio", compared->mean_ratio}};
  nlohmann::ordered_json object;
  std::string table;
  for (const auto& [name, value] : figures) {
    object[name] = finite_or_null(value);
    table += fmt::format("{:<19} {:.6g}\n", name, value);
  }
  std::fputs(options.json ? (object.dump(2) + "\n").c_str() : table.c_str(), stdout);
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = program.add_subcommand("compare", "Compare a picture with a reference");
  command->footer(kExamples);
  command->add_option("PICTURE", options->picture, "OpenEXR file")->required();
  command->add_option("REFERENCE", options->reference, "OpenEXR file of the same size")->required();
  command->add_option("--exposure", options->exposure, "display value per radiance, for FLIP only")
      ->check(CLI::PositiveNumber);
  command->add_flag("--json", options->json, "print a JSON object");
  command->callback([options, &chosen] { chosen = [options] { return run_compare(*options); }; });
}

}  // namespace luciole
