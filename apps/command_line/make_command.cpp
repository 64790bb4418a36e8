// SPDX-License-Identifier: Apache-2.0
// luciole make: a recipe's scene as a glTF file, for other programs.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

#include "apps/command_line/commands.h"
#include "apps/command_line/output_files.h"
#include "apps/command_line/progress.h"
#include "scene/gltf_writer.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

constexpr const char* kExamples = R"(Examples:
  luciole make ring alpha=0.1 -o ring.glb
  luciole make lights count=1000 -o lights.gltf)";

struct MakeOptions {
  std::string recipe, output;
  std::vector<std::string> parameters;
};

std::string describe_recipes() {
  std::string text = "Recipes:\n";
  for (const RecipeDescription& recipe : recipes()) {
    text += fmt::format("  {:<10} {}\n", recipe.name, recipe.summary);
    for (const RecipeParameter& parameter : recipe.parameters) {
      text += fmt::format("  {:<10}   {}={}  {}, {} to {}\n", "", parameter.name, parameter.default_value,
                          parameter.meaning, parameter.low, parameter.high);
    }
  }
  return text + "\n" + kExamples;
}

Result<std::map<std::string, std::string>> read_parameters(const std::vector<std::string>& words) {
  std::map<std::string, std::string> parameters;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      return Error{ErrorKind::usage, "parameters are written key=value, not '" + word + "'"};
    }
    if (!parameters.emplace(word.substr(0, equals), word.substr(equals + 1)).second) {
      return Error{ErrorKind::usage, "'" + word.substr(0, equals) + "' is given twice"};
    }
  }
  return parameters;
}

Result<int> run_make(const MakeOptions& options) {
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension != ".glb" && extension != ".gltf") {
    return Error{ErrorKind::usage, options.output + ": scenes end in .glb or .gltf"};
  }
  const Result<std::map<std::string, std::string>> parameters = read_parameters(options.parameters);
  if (!parameters) return parameters.error();
  if (Status status = check_writable(options.output); !status) return status.error();
  Progress progress(Verbosity::normal);
  progress.step("making " + options.recipe);
  const Result<Scene> scene = make_recipe(options.recipe, *parameters);
  if (!scene) return scene.error();
  progress.step("writing " + options.output);
  const Status written = write_gltf(*scene, options.output);
  if (!written) return written.error();
  return 0;
}

}  // namespace

void add_make_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<MakeOptions>();
  CLI::App* command = program.add_subcommand("make", "Write the scene of a recipe as glTF");
  command->footer(describe_recipes());
  command->add_option("RECIPE", options->recipe, "which one")->required();
  command->add_option("PARAMETERS", options->parameters, "key=value ...");
  command->add_option("-o,--output", options->output, "FILE.glb or FILE.gltf")->required();
  command->callback([options, &chosen] { chosen = [options] { return run_make(*options); }; });
}

}  // namespace luciole
