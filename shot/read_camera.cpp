// SPDX-License-Identifier: Apache-2.0
#include "shot/read_camera.h"

#include <fmt/format.h>

#include <numbers>

#include "shot/table_reader.h"

namespace luciole {
namespace {

constexpr NumberLimits kAny{};
constexpr NumberLimits kDegrees{.low = 0, .high = 175, .above_low = true};

float radians(float degrees) { return degrees * (std::numbers::pi_v<float> / 180); }

// At a time or at a frame, as all keys of a path.
CameraKey read_key(TableReader key, float usual_degrees, bool in_frames) {
  CameraKey read;
  const char *unit = in_frames ? "frame" : "time", *other = in_frames ? "time" : "frame";
  const std::optional<float> at = key.number(unit, {.low = 0});
  if (key.number(other, {.low = 0})) key.refuse(fmt::format("has '{}', but the first key has '{}'", other, unit));
  read.at = key.required(unit, at);
  read.eye = key.required("eye", key.vector("eye", kAny));
  read.target = key.required("target", key.vector("target", kAny));
  read.vertical_fov = radians(key.number("vertical_fov_degrees", kDegrees).value_or(usual_degrees));
  if (!(length(read.target - read.eye) > 0)) key.refuse("needs a 'target' away from its 'eye'");
  key.refuse_unknown_keys();
  return read;
}

CameraPath read_path(const std::vector<const toml::table*>& tables, float usual_degrees, const std::string& file,
                     std::optional<Error>& fault) {
  CameraPath path;
  path.in_frames = tables.front()->contains("frame");
  for (const toml::table* table : tables) {
    TableReader key(*table, fmt::format("{}: [[camera.key]] {}", file, path.keys.size() + 1), fault);
    path.keys.push_back(read_key(key, usual_degrees, path.in_frames));
    if (path.keys.size() > 1 && !(path.keys.back().at > path.keys[path.keys.size() - 2].at)) {
      key.refuse(fmt::format("needs a '{}' after that of the key before it", path.in_frames ? "frame" : "time"));
    }
  }
  return path;
}

}  // namespace

void read_camera(const toml::table& table, const std::string& file, std::optional<Error>& fault, Shot& shot) {
  TableReader camera(table, file + ": [camera]", fault);
  const float degrees = camera.number("vertical_fov_degrees", kDegrees).value_or(60.0f);
  const bool moves = table.contains("key");
  const std::vector<const toml::table*> keys = camera.tables("key");
  const std::optional<Vec3> eye = camera.vector("eye", kAny), target = camera.vector("target", kAny);
  if (moves && (eye || target)) camera.refuse("has 'eye' or 'target' beside [[camera.key]]: the keys say where it is");
  if (moves && keys.size() < 2) camera.refuse("needs at least two [[camera.key]], or 'eye' and 'target' instead");
  if (!moves) shot.camera = look_at(camera.required("eye", eye), camera.required("target", target), radians(degrees));
  camera.refuse_unknown_keys();
  if (fault || !moves) return;
  CameraPath path = read_path(keys, degrees, file, fault);
  if (fault) return;
  shot.camera = camera_at(path, 0, shot.frames_per_second);
  shot.camera_path = std::move(path);
}

}  // namespace luciole
