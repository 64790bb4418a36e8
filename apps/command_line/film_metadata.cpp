// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/film_metadata.h"

#include <set>
#include <string_view>

#include "apps/command_line/output_files.h"
#include "apps/command_line/version.h"
#include "base/isa.h"
#include "scene/digest.h"

namespace luciole {
namespace {

constexpr std::string_view kPrefix = "luciole.";

std::string text_of(Vec3 v) { return number_text(v.x) + "," + number_text(v.y) + "," + number_text(v.z); }

// In the words of a sentence: "luciole.pixel_filter" is "pixel_filter".
std::string said(std::string_view name) {
  return std::string(name.substr(0, kPrefix.size()) == kPrefix ? name.substr(kPrefix.size()) : name);
}

std::string describe(const std::string& name, const std::string& its, const std::string& wanted) {
  if (name == "luciole.scene_digest") return "its scene is another one (meshes, materials, textures, lights or sky)";
  return "its " + said(name) + " is '" + its + "', not '" + wanted + "'";
}

}  // namespace

Metadata path_metadata(const std::string& shot, const Scene& scene, const Camera& camera, const PathSettings& chosen) {
  Metadata metadata;
  for (const auto& [name, text] : path_setting_table().as_text(chosen)) metadata["luciole." + name] = text;
  if (const Result<Isa> isa = choose_isa(chosen.isa)) metadata["luciole.isa"] = to_string(*isa);
  metadata["luciole.version"] = kVersion;
  metadata["luciole.method"] = "path";
  metadata["luciole.shot"] = shot;
  metadata["luciole.scene_digest"] = scene_digest(scene);
  metadata["luciole.camera"] = text_of(camera.eye) + "/" + text_of(camera.right) + "/" + text_of(camera.up) + "/" +
                               text_of(camera.forward) + "/" + number_text(camera.vertical_fov);
  return metadata;
}

std::string difference(const Metadata& its, const Metadata& wanted) {
  std::vector<std::string> names = {"luciole.version", "luciole.shot", "luciole.size"};
  // The tracer may have chosen these: they differ where other things do, which are to be said.
  const std::set<std::string> last = {"luciole.error_bound", "luciole.focus"};
  for (const Metadata* side : {&wanted, &its}) {
    for (const auto& [name, text] : *side) {
      if (!last.contains(name)) names.push_back(name);
    }
  }
  names.insert(names.end(), last.begin(), last.end());
  for (const std::string& name : names) {
    const auto a = its.find(name), b = wanted.find(name);
    if (a == its.end() && b == wanted.end()) continue;
    if (a == its.end()) return "it has no " + said(name);
    if (b == wanted.end()) return "it has a " + said(name) + ", '" + a->second + "'";
    if (a->second != b->second) return describe(name, a->second, b->second);
  }
  return {};
}

Image picture_of(const FilmFile& file, const std::vector<std::string>& layers) {
  Image picture = file.film.image(layers);
  picture.metadata = file.metadata;
  picture.metadata["luciole.samples"] = std::to_string(file.film.range().count());
  return picture;
}

Status write_film_outputs(const FilmFile& file, const std::vector<std::filesystem::path>& names,
                          const std::vector<std::string>& layers, ToneCurve curve, bool as_part) {
  const Image picture = picture_of(file, layers);
  for (const std::filesystem::path& name : names) {
    Status status = as_part && name.extension() == ".exr" ? write_film(file, name)
                                                          : write_picture(picture, name, file.film.exposure(), curve);
    if (!status) return status;
  }
  return Done{};
}

}  // namespace luciole
