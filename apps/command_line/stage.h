// SPDX-License-Identifier: Apache-2.0
// Between a shot and the renderer: which camera, which lights are primary, which sky.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "real_time/reflective_shadow_map/primary_light.h"
#include "scene/scene.h"
#include "shot/open_shot.h"

namespace luciole {

// The shot, with the sky and the camera that the command line asks for; empty: not asked for.
Result<OpenedShot> open_stage(const Shot& shot, const SearchFolders& folders, const std::string& environment,
                              const std::string& camera);

// A camera of the scene by name or index (from 0), or "eye/target/degrees" with "x,y,z" in metres and the vertical
// field of view; "/degrees" may be left out.
Result<Camera> choose_camera(const Scene& scene, const std::string& text);

// Which one is meant by name or index; none: "eye/target/degrees", or nothing that is known.
std::optional<std::size_t> scene_camera_named(const Scene& scene, const std::string& text);

// The four lights of most power: those that get virtual point lights and shadows when the shot lists no primary lights.
PrimaryLights strongest_as_primary(const Scene& scene);

// What the real-time frame cannot do for this scene, a sentence each: directional lights that are not primary shine
// not.
std::vector<std::string> left_out(const Scene& scene, const PrimaryLights& primaries);

// A sky from an equirectangular picture: OpenEXR (.exr) or Radiance (.hdr).
Result<Environment> read_environment(const std::filesystem::path& path);

}  // namespace luciole
