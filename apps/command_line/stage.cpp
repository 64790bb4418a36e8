// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/stage.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "image/exr.h"
#include "scene/default_lights.h"
#include "scene/load_environment.h"

namespace luciole {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

template <class T>
std::optional<T> parse(std::string_view text) {
  T number{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<Vec3> parse_point(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 3) return std::nullopt;
  float axis[3];
  for (int i = 0; i < 3; ++i) {
    const std::optional<float> number = parse<float>(parts[static_cast<std::size_t>(i)]);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    axis[i] = *number;
  }
  return Vec3(axis[0], axis[1], axis[2]);
}

std::optional<Camera> parse_camera(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, '/');
  if (parts.size() < 2 || parts.size() > 3) return std::nullopt;
  const std::optional<Vec3> eye = parse_point(parts[0]), target = parse_point(parts[1]);
  const std::optional<float> degrees = parts.size() == 3 ? parse<float>(parts[2]) : 60.0f;
  if (!eye || !target || !degrees || !(*degrees > 0 && *degrees < 180) || length(*target - *eye) <= 0) {
    return std::nullopt;
  }
  return look_at(*eye, *target, *degrees * (std::numbers::pi_v<float> / 180));
}

}  // namespace

Result<OpenedShot> open_stage(const Shot& shot, const SearchFolders& folders, const std::string& environment,
                              const std::string& camera) {
  Result<OpenedShot> opened = open_shot(shot, folders);
  if (!opened) return opened;
  if (!environment.empty()) {
    Result<Environment> sky = read_environment(environment);
    if (!sky) return sky.error();
    opened->scene.environment = std::move(*sky);
  }
  if (!camera.empty()) {
    Result<Camera> chosen = choose_camera(opened->scene, camera);
    if (!chosen) return chosen.error();
    opened->camera = *chosen;
    opened->scene_camera = scene_camera_named(opened->scene, camera);
  }
  return opened;
}

std::optional<std::size_t> scene_camera_named(const Scene& scene, const std::string& text) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].name == text) return i;
  }
  const std::optional<std::size_t> index = parse<std::size_t>(text);
  return index && *index < scene.cameras.size() ? index : std::nullopt;
}

Result<Camera> choose_camera(const Scene& scene, const std::string& text) {
  if (const std::optional<std::size_t> index = scene_camera_named(scene, text)) return scene.cameras[*index];
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) {
    names.push_back(std::to_string(names.size()) + (camera.name.empty() ? "" : " '" + camera.name + "'"));
  }
  if (const std::optional<Camera> camera = parse_camera(text)) return *camera;
  return Error{ErrorKind::usage,
               "--camera must be x,y,z/x,y,z/degrees (eye, target, vertical field of view)" +
                   (names.empty() ? ": the scene has no cameras" : " or one of the scene's cameras: " + joined(names)) +
                   "; not '" + text + "'"};
}

PrimaryLights strongest_as_primary(const Scene& scene) {
  PrimaryLights primaries;
  for (const std::size_t index : strongest_lights(scene)) primaries.push_back(scene.lights[index]);
  return primaries;
}

std::vector<std::string> left_out(const Scene& scene, const PrimaryLights& primaries) {
  std::size_t directional = 0;
  for (const std::uint32_t index : other_lights(scene, primaries)) {
    directional += scene.lights[index].kind == PunctualLight::Kind::directional;
  }
  if (directional == 0) return {};
  return {std::to_string(directional) +
          " directional light(s) of the scene are not primary: they shine directly, with shadows, but not indirectly."};
}

Result<Environment> read_environment(const std::filesystem::path& path) {
  if (path.extension() == ".hdr") return load_environment(path);
  const Result<Image> image = read_exr(path);
  if (!image) return image.error();
  Environment sky{Vec3(1, 1, 1), image->width, image->height, image->colours("")};
  if (sky.pixels.empty()) return Error{ErrorKind::failed, path.string() + ": has no colour to light with"};
  const auto unusable = [](Vec3 radiance) {
    return !(std::isfinite(radiance.x + radiance.y + radiance.z) && radiance.x >= 0 && radiance.y >= 0 &&
             radiance.z >= 0);
  };
  if (std::any_of(sky.pixels.begin(), sky.pixels.end(), unusable)) {
    return Error{ErrorKind::failed, path.string() + ": a sky needs finite values that are not negative"};
  }
  return sky;
}

}  // namespace luciole
