// SPDX-License-Identifier: Apache-2.0
// Door: a shot says what to look at and how. One TOML file: scene, camera, primary lights, materials, settings.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"
#include "shot/camera_path.h"

namespace luciole {

// Replaces what the scene says about the materials whose names match.
struct MaterialOverride {
  std::string name_pattern;        // "*" any text, "?" any character
  std::optional<float> ggx_alpha;  // [TH17] alpha, (0, 1]
  std::optional<float> metallic;   // [0, 1]
};

struct Shot {
  std::string scene;                      // "recipe:ring?alpha=0.1", or a file relative to the folders of scenes
  float scale = 1;                        // metres per unit of the file; everything below is in metres already
  float frames_per_second = 30;           // frame k is at the time k / frames_per_second [s]
  std::optional<Camera> camera;           // of frame 0; none: the scene's first camera, or one that frames it
  std::optional<CameraPath> camera_path;  // of all frames; none: the camera rests
  std::vector<PunctualLight> primary;     // none: the scene's strongest punctual lights
  std::vector<MaterialOverride> materials;
  std::optional<Vec3> environment;  // radiance of a constant sky [W/(m^2 sr)]
  // [settings] but `environment`, as text; each renderer knows which names and values are valid.
  std::vector<std::pair<std::string, std::string>> settings;
};

// Reads the text of a shot. Unknown keys, wrong types and values out of range are refused with one sentence that names
// the file, the key and what would be valid.
//   name   of the file, for that sentence
Result<Shot> parse_shot(std::string_view text, const std::string& name);

// A regular file of at most 1 MiB.
Result<Shot> read_shot(const std::filesystem::path& path);

}  // namespace luciole
