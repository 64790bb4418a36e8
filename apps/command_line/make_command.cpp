// SPDX-License-Identifier: Apache-2.0
// luciole make: a recipe's scene as a glTF file or for pbrt, for other programs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>

#include "apps/command_line/commands.h"
#include "apps/command_line/output_files.h"
#include "apps/command_line/progress.h"
#include "base/setting_table.h"
#include "scene/gltf_writer.h"
#include "scene/pbrt_writer.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

constexpr const char* kExamples = R"(Examples:
  luciole make ring alpha=0.1 -o ring.glb
  luciole make lights count=1000 -o lights.gltf
  luciole make lamps count=5000 matte=1 --size 640x360 -o lamps.pbrt)";

struct MakeOptions {
  std::string recipe, output;
  std::vector<std::string> parameters;
  std::map<std::string, std::string> picture;  // by name in picture_settings()
};

// What a file for pbrt says beside the scene.
const SettingTable<PbrtPicture>& picture_settings() {
  const auto positive = [](std::uint32_t value) { return value >= 1 && value <= 0x7fffffffu; };
  static const SettingTable<PbrtPicture> table(
      {size_entry<PbrtPicture>(),
       whole_entry<PbrtPicture, std::uint32_t>("bounces", "surface scatterings; 1: direct light only",
                                               "a whole number above 0", &PbrtPicture::bounces, positive),
       whole_entry<PbrtPicture, std::uint32_t>("samples", "samples per pixel", "a whole number above 0",
                                               &PbrtPicture::samples, positive)});
  return table;
}

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

Result<PbrtPicture> read_picture(const MakeOptions& options, bool for_pbrt) {
  PbrtPicture picture;
  for (const auto& [name, text] : options.picture) {
    if (!for_pbrt) return Error{ErrorKind::usage, "--" + name + " is for .pbrt only: glTF has no word for it"};
    const Status set = picture_settings().set(picture, name, text);
    if (!set) return Error{ErrorKind::usage, "--" + set.error().message};
  }
  return picture;
}

Result<int> run_make(const MakeOptions& options) {
  const std::string extension = std::filesystem::path(options.output).extension().string();
  const bool for_pbrt = extension == ".pbrt";
  if (extension != ".glb" && extension != ".gltf" && !for_pbrt) {
    return Error{ErrorKind::usage, options.output + ": scenes end in .glb, .gltf or .pbrt"};
  }
  const Result<PbrtPicture> picture = read_picture(options, for_pbrt);
  if (!picture) return picture.error();
  const Result<std::map<std::string, std::string>> parameters = read_parameters(options.parameters);
  if (!parameters) return parameters.error();
  if (Status status = check_writable(options.output); !status) return status.error();
  Progress progress(Verbosity::normal);
  progress.step("making " + options.recipe);
  const Result<Scene> scene = make_recipe(options.recipe, *parameters);
  if (!scene) return scene.error();
  progress.step("writing " + options.output);
  const Status written = for_pbrt ? write_pbrt(*scene, *picture, options.output) : write_gltf(*scene, options.output);
  if (!written) return written.error();
  return 0;
}

}  // namespace

void add_make_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<MakeOptions>();
  CLI::App* command = program.add_subcommand("make", "Write the scene of a recipe as glTF or for pbrt");
  command->footer(describe_recipes());
  command->add_option("RECIPE", options->recipe, "which one")->required();
  command->add_option("PARAMETERS", options->parameters, "key=value ...");
  command->add_option("-o,--output", options->output, "FILE.glb, FILE.gltf or FILE.pbrt")->required();
  for (const std::string& name : picture_settings().names()) {
    command->add_option_function<std::string>(
        "--" + name, [options, name](const std::string& text) { options->picture[name] = text; },
        picture_settings().help(name) + " (.pbrt)");
  }
  command->callback([options, &chosen] { chosen = [options] { return run_make(*options); }; });
}

}  // namespace luciole
