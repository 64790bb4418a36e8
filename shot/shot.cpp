// SPDX-License-Identifier: Apache-2.0
#include "shot/shot.h"

#include <cmath>
#include <numbers>

#include "scene/file_access.h"
#include "shot/read_camera.h"
#include "shot/table_reader.h"

namespace luciole {
namespace {

constexpr std::uint64_t kLargestFile = 1 << 20;  // [bytes]
constexpr NumberLimits kAny{};
constexpr NumberLimits kNotNegative{.low = 0};

float radians(float degrees) { return degrees * (std::numbers::pi_v<float> / 180); }

// Where a sun or a spot shines to: its target as seen from its position, or a direction.
Vec3 read_direction(TableReader& light, std::optional<Vec3> position) {
  const std::optional<Vec3> target = light.vector("target", kAny), direction = light.vector("direction", kAny);
  if (target.has_value() == direction.has_value()) light.refuse("needs either 'target' or 'direction'");
  if (target && !position) light.refuse("needs 'position' beside 'target'");
  const Vec3 towards = direction ? *direction : target.value_or(Vec3(0, 0, 0)) - position.value_or(Vec3(0, 0, 0));
  const float distance = length(towards);
  if (!(distance > 0)) light.refuse("shines nowhere: its direction has no length");
  return distance > 0 ? towards / distance : Vec3(0, -1, 0);
}

void read_cone(TableReader& light, PunctualLight& spot) {
  // Angles from the axis, as glTF's innerConeAngle and outerConeAngle.
  const float outer = light.number("outer_degrees", {.low = 0, .high = 90, .above_low = true}).value_or(45.0f);
  const float inner = light.number("inner_degrees", {.low = 0, .high = 90}).value_or(0.0f);
  if (inner >= outer) light.refuse("needs 'inner_degrees' below 'outer_degrees'");
  spot.cos_inner = std::cos(radians(inner));
  spot.cos_outer = std::cos(radians(outer));
}

PunctualLight read_primary(TableReader light) {
  PunctualLight primary;
  primary.name = light.text("name").value_or("");
  const std::string kind = light.required("kind", light.text("kind"));
  const std::optional<Vec3> position = light.vector("position", kAny);
  if (kind == "sun") {
    primary.kind = PunctualLight::Kind::directional;
    primary.direction = read_direction(light, position);
    primary.intensity = light.required("irradiance", light.vector("irradiance", kNotNegative));
  } else if (kind == "spot" || kind == "point") {
    primary.kind = kind == "spot" ? PunctualLight::Kind::spot : PunctualLight::Kind::point;
    primary.position = light.required("position", position);
    primary.intensity = light.required("intensity", light.vector("intensity", kNotNegative));
    if (kind == "spot") primary.direction = read_direction(light, position), read_cone(light, primary);
  } else {
    light.refuse("needs 'kind' to be one of sun, spot, point");
  }
  light.refuse_unknown_keys();
  return primary;
}

// [[materials]] with a name, or one [materials] for all.
MaterialOverride read_material(TableReader material, bool for_all) {
  MaterialOverride replaced;
  replaced.name_pattern = for_all ? "*" : material.required("name", material.text("name"));
  replaced.ggx_alpha = material.number("ggx_alpha", {.low = 0, .high = 1, .above_low = true});
  replaced.metallic = material.number("metallic", {.low = 0, .high = 1});
  if (!replaced.ggx_alpha && !replaced.metallic) material.refuse("needs 'ggx_alpha' or 'metallic'");
  material.refuse_unknown_keys();
  return replaced;
}

void read_settings(TableReader settings, Shot& shot) {
  shot.environment = settings.vector("environment", kNotNegative);
  for (const std::string& key : settings.keys()) {
    if (key == "environment") continue;
    if (const std::optional<std::string> text = settings.as_text(key)) shot.settings.emplace_back(key, *text);
  }
}

Result<Shot> read_table(const toml::table& table, const std::string& name) {
  std::optional<Error> fault;
  TableReader file(table, name + ":", fault);
  const auto inner = [&](const toml::table& part, const char* title) {
    return TableReader(part, name + ": " + title, fault);
  };
  Shot shot;
  shot.scene = file.required("scene", file.text("scene"));
  shot.scale = file.number("scale", {.low = 0, .above_low = true}).value_or(1.0f);
  shot.frames_per_second =
      file.number("frames_per_second", {.low = 0, .high = 1000, .above_low = true}).value_or(shot.frames_per_second);
  if (const toml::table* camera = file.table("camera")) read_camera(*camera, name, fault, shot);
  for (const toml::table* light : file.tables("primary")) {
    shot.primary.push_back(read_primary(inner(*light, "[[primary]]")));
  }
  if (table["materials"].is_table()) {
    shot.materials.push_back(read_material(inner(*file.table("materials"), "[materials]"), true));
  } else {
    for (const toml::table* material : file.tables("materials")) {
      shot.materials.push_back(read_material(inner(*material, "[[materials]]"), false));
    }
  }
  if (const toml::table* settings = file.table("settings")) read_settings(inner(*settings, "[settings]"), shot);
  file.refuse_unknown_keys();
  if (fault) return *fault;
  return shot;
}

}  // namespace

Result<Shot> parse_shot(std::string_view text, const std::string& name) try {
  return read_table(toml::parse(text), name);
} catch (const toml::parse_error& fault) {
  return Error{ErrorKind::bad_scene,
               name + ": line " + std::to_string(fault.source().begin.line) + ": " + std::string(fault.description())};
}

Result<Shot> read_shot(const std::filesystem::path& path) {
  const Result<Bytes> bytes = read_regular_file(path, kLargestFile);
  if (!bytes) return Error{bytes.error().kind, path.string() + ": " + bytes.error().message};
  return parse_shot({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

}  // namespace luciole
