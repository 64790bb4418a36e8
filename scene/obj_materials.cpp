// SPDX-License-Identifier: Apache-2.0
#include "scene/obj_materials.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/decode_image.h"
#include "scene/file_fault.h"
#include "scene/text_lines.h"
#include "scene/uri.h"

namespace luciole::obj {
namespace {

constexpr const char* kDefaultName = "";

// Numbers as far as they go: one stands for all three, as "Kd .5" does. Other colour models keep the fallback.
Vec3 read_colour(Words& words, Vec3 fallback) {
  const std::optional<float> r = words.number();
  if (!r) return fallback;
  const std::optional<float> g = words.number(), b = words.number();
  const auto valid = [](float x) { return std::max(x, 0.0f); };
  return {valid(*r), valid(g.value_or(*r)), valid(b.value_or(*r))};
}

float largest(Vec3 v) { return std::max({v.x, v.y, v.z}); }

// Windows separators become ours; what leaves the folder gives nothing.
std::optional<std::string> plain_path(std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  while (path.starts_with("./")) path.erase(0, 2);
  if (!stays_below_folder(path)) return std::nullopt;
  return path;
}

// Options in front of a texture's name.
struct TextureOptions {
  Vec2 scale{1, 1}, offset{0, 0};
  bool clamped = false;
  std::string_view name;
};

TextureOptions read_options(std::string_view statement) {
  TextureOptions options;
  Words words(statement);
  std::string_view rest = words.rest();
  while (rest.starts_with('-')) {
    const std::string_view option = words.next();
    if (option == "-s" || option == "-o" || option == "-t") {
      const std::optional<float> u = words.number(), v = words.number();
      words.number();
      if (option == "-s") options.scale = {u.value_or(1), v.value_or(1)};
      if (option == "-o") options.offset = {u.value_or(0), v.value_or(0)};
    } else if (option == "-mm") {
      words.next(), words.next();
    } else {
      const std::string_view value = words.next();  // every other option has one argument
      if (option == "-clamp") options.clamped = value == "on";
    }
    rest = words.rest();
  }
  options.name = rest;
  return options;
}

}  // namespace

// One newmtl block.
struct MaterialLibrary::Phong {
  std::string name;
  Vec3 diffuse{0.8f, 0.8f, 0.8f}, specular{0, 0, 0}, emission{0, 0, 0};
  float exponent = 0, opacity = 1;
  int illumination = 2;
  std::string map_diffuse, map_emission, map_normal;

  void read_statement(std::string_view keyword, Words& words, MaterialLibrary& library) {
    if (keyword == "Kd") {
      diffuse = read_colour(words, diffuse);
    } else if (keyword == "Ks") {
      specular = read_colour(words, specular);
    } else if (keyword == "Ke") {
      emission = read_colour(words, emission);
    } else if (keyword == "Ns") {
      exponent = std::max(words.number().value_or(0), 0.0f);
    } else if (keyword == "d") {
      opacity = words.number().value_or(1);
    } else if (keyword == "Tr") {
      opacity = 1 - words.number().value_or(0);
    } else if (keyword == "illum") {
      illumination = static_cast<int>(std::clamp(words.number().value_or(2), 0.0f, 10.0f));
    } else if (keyword == "map_Kd") {
      map_diffuse = words.rest();
    } else if (keyword == "map_Ke") {
      map_emission = words.rest();
    } else if (keyword == "norm") {
      map_normal = words.rest();
    } else if (keyword == "bump" || keyword == "map_bump" || keyword == "map_Bump") {
      library.warn("bump", "Height maps (bump) of OBJ materials are ignored.");
    } else if (keyword == "map_d") {
      library.warn("map_d", "Opacity maps (map_d) of OBJ materials are ignored.");
    }
  }
};

void MaterialLibrary::warn(const std::string& key, const std::string& sentence) {
  if (warned_.insert(key).second) warnings_.push_back(sentence);
}

void MaterialLibrary::read_file(const std::string& name) {
  if (!files_read_.insert(name).second) return;
  const std::optional<std::string> path = plain_path(name);
  const Result<Bytes> file = path ? files_(*path) : Result<Bytes>(Error{ErrorKind::bad_scene, "leaves the folder"});
  if (!file) {
    warn("mtllib", "The material file \"" + printable(name) + "\" cannot be read; materials are plain.");
    return;
  }
  Lines lines({reinterpret_cast<const char*>(file->data()), file->size()});
  std::optional<Phong> current;
  while (const std::optional<std::string_view> line = lines.next()) {
    Words words(*line);
    const std::string_view keyword = words.next();
    if (keyword == "newmtl") {
      if (current) define(*current);
      current.emplace();
      current->name = words.rest();
    } else if (current) {
      current->read_statement(keyword, words, *this);
    }
  }
  if (current) define(*current);
}

void MaterialLibrary::define(const Phong& phong) {
  Material material;
  material.name = phong.name;
  material.double_sided = false;
  material.metallic = 0;
  const bool is_shiny = largest(phong.specular) > 0;
  material.roughness = is_shiny ? std::pow(2.0f / (phong.exponent + 2.0f), 0.25f) : 1.0f;
  Vec3 colour = phong.map_diffuse.empty() ? phong.diffuse : Vec3(1, 1, 1);
  if ((phong.illumination == 3 || phong.illumination == 5) && largest(phong.specular) >= 0.5f) {
    colour = phong.specular;
    material.metallic = 1;
    material.roughness = 0;
  }
  material.base_colour = {colour.x, colour.y, colour.z, std::clamp(phong.opacity, 0.0f, 1.0f)};
  if (material.base_colour.w < 1) material.alpha_mode = AlphaMode::blend;
  material.emission = phong.emission;
  if (!phong.map_diffuse.empty()) material.base_colour_texture = texture(phong.map_diffuse, true);
  if (!phong.map_normal.empty()) material.normal_texture = texture(phong.map_normal, false);
  if (!phong.map_emission.empty()) {
    material.emissive_texture = texture(phong.map_emission, true);
    if (!(largest(material.emission) > 0)) material.emission = {1, 1, 1};
    if (material.emissive_texture.texture < 0) material.emission = phong.emission;
  }
  const auto [entry, is_new] = by_name_.try_emplace(phong.name, static_cast<std::uint32_t>(materials_.size()));
  if (is_new) materials_.push_back(std::move(material));
}

TextureSlot MaterialLibrary::texture(std::string_view statement, bool srgb) {
  const TextureOptions options = read_options(statement);
  TextureSlot slot;
  const std::optional<std::string> path = plain_path(options.name);
  if (path) slot.texture = request_image(*path, srgb, options.clamped);
  if (slot.texture < 0) {
    const std::string name = printable(std::string(options.name));
    warn("image " + name, "The texture \"" + name + "\" is ignored: it is no readable PNG or JPEG below the folder.");
  }
  // MTL scales and shifts with v upwards; ours points down: v' = 1 - (s (1 - v) + o).
  slot.a = options.scale.x;
  slot.d = options.scale.y;
  slot.offset = {options.offset.x, 1 - options.scale.y - options.offset.y};
  return slot;
}

std::int32_t MaterialLibrary::request_image(const std::string& path, bool srgb, bool clamped) {
  auto known = images_.find(path);
  if (known == images_.end()) {
    Result<Bytes> file = files_(path);
    if (!file || !(is_png(*file) || is_jpeg(*file))) return -1;
    known = images_.emplace(path, ImageRequest{}).first;
    known->second.label = "image \"" + printable(path) + "\"";
    known->second.storage = std::move(*file);
    known->second.file = known->second.storage;
  }
  (srgb ? known->second.as_srgb : known->second.as_numbers) = true;
  const Wrap wrap = clamped ? Wrap::clamp_to_edge : Wrap::repeat;
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    if (image_of_texture_[i] == std::pair(path, srgb) && textures_[i].wrap_u == wrap)
      return static_cast<std::int32_t>(i);
  }
  Texture texture;
  texture.name = path;
  texture.wrap_u = texture.wrap_v = wrap;
  textures_.push_back(std::move(texture));
  image_of_texture_.emplace_back(path, srgb);
  return static_cast<std::int32_t>(textures_.size() - 1);
}

std::uint32_t MaterialLibrary::find(const std::string& name) {
  const auto known = by_name_.find(name);
  if (known != by_name_.end()) return known->second;
  warn("usemtl", "The material \"" + printable(name) + "\" is not defined; what uses it is plain grey.");
  return default_material();
}

std::uint32_t MaterialLibrary::default_material() {
  const auto [entry, is_new] = by_name_.try_emplace(kDefaultName, static_cast<std::uint32_t>(materials_.size()));
  if (is_new) {
    Material material;
    material.name = "default";
    material.base_colour = {0.8f, 0.8f, 0.8f, 1};
    material.metallic = 0;
    materials_.push_back(std::move(material));
  }
  return entry->second;
}

void MaterialLibrary::finish(Scene& scene) {
  if (materials_.empty()) default_material();
  std::vector<ImageRequest*> requests;
  for (auto& [path, request] : images_) requests.push_back(&request);
  decode_images(requests, limits_);
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    const ImageRequest& request = images_.at(image_of_texture_[i].first);
    textures_[i].image = image_of_texture_[i].second ? request.srgb : request.numbers;
  }
  scene.materials = std::move(materials_);
  scene.textures = std::move(textures_);
  scene.warnings = std::move(warnings_);
}

}  // namespace luciole::obj
