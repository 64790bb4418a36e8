// SPDX-License-Identifier: Apache-2.0
// luciole info: what is in a scene, and what a shot of it would have to know.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "apps/command_line/commands.h"
#include "apps/command_line/folders.h"
#include "scene/describe.h"
#include "shot/open_shot.h"

namespace luciole {
namespace {

constexpr const char* kExamples = R"(Examples:
  luciole info sponza/sponza.gltf --scenes ~/scenes
  luciole info "recipe:lights?count=1000"
  luciole info gallery)";

struct InfoOptions {
  std::string scene, scenes;
};

Result<int> run_info(const InfoOptions& options) {
  const SearchFolders folders = search_folders(options.scenes);
  const Result<Shot> shot = find_shot(options.scene, folders);
  if (!shot) return shot.error();
  const Result<Scene> scene = load_shot_scene(*shot, folders);
  if (!scene) return scene.error();
  std::fputs(describe(*scene).c_str(), stdout);
  return 0;
}

}  // namespace

void add_info_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* command = program.add_subcommand("info", "Tell what is in a scene");
  command->footer(kExamples);
  command->add_option("SCENE", options->scene, "a .gltf, .glb or .obj, a shot, or recipe:NAME?key=value")->required();
  command->add_option("--scenes", options->scenes, "folder of scenes (else $LUCIOLE_SCENES, else ./scenes)");
  command->callback([options, &chosen] { chosen = [options] { return run_info(*options); }; });
}

}  // namespace luciole
