// SPDX-License-Identifier: Apache-2.0
#include "shot/open_shot.h"

#include <algorithm>
#include <cmath>

#include "scene/animation.h"
#include "scene/default_lights.h"
#include "scene/framing_camera.h"
#include "scene/load_scene.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

Result<Scene> load(const Shot& shot, const SearchFolders& folders) {
  if (is_recipe_address(shot.scene)) return make_recipe_from_address(shot.scene);
  const Result<std::filesystem::path> path = find_scene_file(shot.scene, folders);
  if (!path) return path.error();
  return load_scene(*path);
}

// The same in another spelling: degrees against radians, a target against a direction.
bool is_repeated(const PunctualLight& a, const PunctualLight& b) {
  constexpr float kSpelling = 1e-4f;
  const auto near = [](Vec3 u, Vec3 v) { return length(u - v) <= kSpelling * (length(u) + length(v)); };
  if (a.kind != b.kind || !near(a.intensity, b.intensity)) return false;
  const bool placed = a.kind != PunctualLight::Kind::directional, aimed = a.kind != PunctualLight::Kind::point;
  if ((placed && !near(a.position, b.position)) || (aimed && !near(a.direction, b.direction))) return false;
  return a.kind != PunctualLight::Kind::spot ||
         (std::abs(a.cos_inner - b.cos_inner) <= kSpelling && std::abs(a.cos_outer - b.cos_outer) <= kSpelling);
}

}  // namespace

void remove_repeated_lights(Scene& scene, const std::vector<PunctualLight>& primary) {
  std::vector<bool> kept;
  for (const PunctualLight& light : scene.lights) {
    kept.push_back(std::none_of(primary.begin(), primary.end(),
                                [&light](const PunctualLight& listed) { return is_repeated(listed, light); }));
  }
  if (scene.animation) scene.animation = with_lights_kept(*scene.animation, kept);
  std::size_t index = 0;
  std::erase_if(scene.lights, [&](const PunctualLight&) { return !kept[index++]; });
}

void scale_scene(Scene& scene, float metres_per_unit) {
  if (metres_per_unit == 1) return;
  for (Mesh& mesh : scene.meshes) {
    for (Vec3& position : mesh.positions) position = position * metres_per_unit;
  }
  for (PunctualLight& light : scene.lights) light.position = light.position * metres_per_unit;
  for (Camera& camera : scene.cameras) camera.eye = camera.eye * metres_per_unit;
  if (!scene.animation) return;
  auto scaled = std::make_shared<Animation>(*scene.animation);
  scaled->metres_per_unit *= metres_per_unit;
  scene.animation = std::move(scaled);
}

bool matches_pattern(std::string_view text, std::string_view pattern) {
  // Greedy with one restart point: only the last star ever needs to take more.
  std::size_t at = 0, in_pattern = 0, star = std::string_view::npos, star_at = 0;
  while (at < text.size()) {
    if (in_pattern < pattern.size() && pattern[in_pattern] == '*') {
      star = in_pattern++, star_at = at;
    } else if (in_pattern < pattern.size() && (pattern[in_pattern] == '?' || pattern[in_pattern] == text[at])) {
      ++in_pattern, ++at;
    } else if (star != std::string_view::npos) {
      in_pattern = star + 1, at = ++star_at;
    } else {
      return false;
    }
  }
  while (in_pattern < pattern.size() && pattern[in_pattern] == '*') ++in_pattern;
  return in_pattern == pattern.size();
}

Status override_materials(Scene& scene, const std::vector<MaterialOverride>& overrides) {
  for (const MaterialOverride& replaced : overrides) {
    bool found = false;
    for (Material& material : scene.materials) {
      if (!matches_pattern(material.name, replaced.name_pattern)) continue;
      found = true;
      if (replaced.ggx_alpha) material.ggx_alpha_override = *replaced.ggx_alpha;
      if (replaced.metallic) material.metallic_override = *replaced.metallic;
    }
    if (!found) {
      return Error{ErrorKind::bad_scene, "[[materials]] name '" + replaced.name_pattern + "' matches none of the " +
                                             std::to_string(scene.materials.size()) + " materials of the scene"};
    }
  }
  return Done{};
}

Result<Scene> load_shot_scene(const Shot& shot, const SearchFolders& folders) {
  Result<Scene> scene = load(shot, folders);
  if (!scene) return scene.error();
  scale_scene(*scene, shot.scale);
  if (Status status = override_materials(*scene, shot.materials); !status) {
    return Error{status.error().kind, shot.scene + ": " + status.error().message};
  }
  return scene;
}

Result<OpenedShot> open_shot(const Shot& shot, const SearchFolders& folders) {
  Result<Scene> loaded = load_shot_scene(shot, folders);
  if (!loaded) return loaded.error();
  OpenedShot opened;
  opened.scene = std::move(*loaded);
  opened.primary = shot.primary;
  Scene& scene = opened.scene;
  if (Status posed = pose_scene(scene, 0); !posed) return posed.error();
  if (scene.triangle_count() == 0) return Error{ErrorKind::bad_scene, shot.scene + ": the scene has no triangle"};
  if (shot.environment) scene.environment = Environment{*shot.environment, 0, 0, {}};
  remove_repeated_lights(scene, shot.primary);
  if (shot.primary.empty()) {
    const std::string added = add_default_lights(scene);
    if (!added.empty()) opened.notes.push_back(added);
  }
  if (shot.camera) {
    opened.camera = *shot.camera;
  } else if (!scene.cameras.empty()) {
    opened.camera = scene.cameras.front();
    opened.scene_camera = 0;
  } else {
    opened.camera = framing_camera(scene);
    opened.notes.push_back("The scene has no camera: it gets one that frames it.");
  }
  return opened;
}

}  // namespace luciole
