// SPDX-License-Identifier: Apache-2.0
// Loads what a shot names and makes it ready to render: in metres, with its materials replaced, seen and lit.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"
#include "shot/find_shot.h"
#include "shot/shot.h"

namespace luciole {

struct OpenedShot {
  Scene scene;  // world space, metres; at least one triangle; at time 0 of its animation
  Camera camera;
  std::optional<std::size_t> scene_camera;  // where `camera` is one of the scene's, and moves with it: which
  std::vector<PunctualLight> primary;       // as the shot lists them; empty: to be chosen among scene.lights
  std::vector<std::string> notes;           // one sentence per default that was filled in
};

// The scene that a shot names: in metres, with its materials replaced; it may lack triangles, lights and cameras.
Result<Scene> load_shot_scene(const Shot& shot, const SearchFolders& folders);

// A shot without camera gets the scene's first one, or one that frames the scene; without primary light, where the
// scene's own light does not show it, the sun and sky of scene/default_lights.h. Both are notes. A scene without a
// triangle is refused.
Result<OpenedShot> open_shot(const Shot& shot, const SearchFolders& folders);

// Removes the scene's lights that the shot repeats as primary (within 1e-4 of their values): the shot means them, and
// they must not shine twice.
void remove_repeated_lights(Scene& scene, const std::vector<PunctualLight>& primary);

// Moves positions of meshes, lights and cameras from file units to metres. Light units stay as they are.
void scale_scene(Scene& scene, float metres_per_unit);

// Refused if a pattern matches no material: a misspelt name must not pass silently.
Status override_materials(Scene& scene, const std::vector<MaterialOverride>& overrides);

// "*" stands for any text, "?" for any character.
bool matches_pattern(std::string_view text, std::string_view pattern);

}  // namespace luciole
