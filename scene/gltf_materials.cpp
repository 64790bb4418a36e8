// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_materials.h"

#include <algorithm>
#include <optional>

#include "scene/file_fault.h"

namespace luciole::gltf {
namespace {

float unit_number(const JsonObject& object, const char* property, float fallback) {
  const float value = object.number(property, fallback);
  if (value < 0 || value > 1) {
    fail("VALUE_NOT_IN_RANGE", object.label(), std::string("property \"") + property + "\" is not between 0 and 1");
  }
  return value;
}

template <std::size_t N>
std::array<float, N> non_negative(const JsonObject& object, const char* property,
                                  const std::array<float, N>& fallback) {
  const std::array<float, N> values = object.numbers<N>(property, fallback);
  if (std::any_of(values.begin(), values.end(), [](float value) { return value < 0; })) {
    fail("VALUE_NOT_IN_RANGE", object.label(), std::string("property \"") + property + "\" has a negative number");
  }
  return values;
}

Vec3 vec3(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
Vec4 vec4(const std::array<float, 4>& v) { return {v[0], v[1], v[2], v[3]}; }

void read_metallic_roughness(const JsonObject& object, TextureReader& textures, Material& material) {
  material.base_colour = vec4(non_negative<4>(object, "baseColorFactor", {1, 1, 1, 1}));
  material.base_colour_texture = textures.slot(object, "baseColorTexture", true);
  material.metallic = unit_number(object, "metallicFactor", 1);
  material.roughness = unit_number(object, "roughnessFactor", 1);
  material.metallic_roughness_texture = textures.slot(object, "metallicRoughnessTexture", false);
}

// The older KHR_materials_pbrSpecularGlossiness, where a material has nothing else: a dielectric with a free F0.
void read_specular_glossiness(const JsonObject& object, Document& document, TextureReader& textures,
                              Material& material) {
  material.base_colour = vec4(non_negative<4>(object, "diffuseFactor", {1, 1, 1, 1}));
  material.base_colour_texture = textures.slot(object, "diffuseTexture", true);
  material.metallic = 0;
  material.roughness = 1 - unit_number(object, "glossinessFactor", 1);
  material.dielectric_f0 = vec3(non_negative<3>(object, "specularFactor", {1, 1, 1}));
  material.dielectric_f0 = min(material.dielectric_f0, Vec3(1, 1, 1));
  if (object.has("specularGlossinessTexture")) {
    document.warn("specularGlossinessTexture",
                  "The textures of KHR_materials_pbrSpecularGlossiness are ignored beyond the "
                  "diffuse one.");
  }
}

// KHR_materials_ior and KHR_materials_specular: F0 = min(((ior - 1) / (ior + 1))^2 * specularColor, 1) * specular.
void read_dielectric_reflection(const JsonObject& object, Document& document, Material& material) {
  float f0 = 0.04f;
  if (const std::optional<JsonObject> extension = object.extension("KHR_materials_ior")) {
    const float ior = extension->number("ior", 1.5f);
    if (ior != 0 && ior < 1)
      fail("VALUE_NOT_IN_RANGE", extension->label(), "property \"ior\" is neither 0 nor at least 1");
    const float ratio = (ior - 1) / (ior + 1);  // ior 0 stands for a mirror: F0 = 1
    f0 = ratio * ratio;
  }
  material.dielectric_f0 = {f0, f0, f0};
  if (const std::optional<JsonObject> extension = object.extension("KHR_materials_specular")) {
    const float specular = unit_number(*extension, "specularFactor", 1);
    const Vec3 colour = vec3(non_negative<3>(*extension, "specularColorFactor", {1, 1, 1}));
    material.dielectric_f0 = min(material.dielectric_f0 * colour, Vec3(1, 1, 1)) * specular;
    material.dielectric_f90 = specular;
    if (extension->has("specularTexture") || extension->has("specularColorTexture")) {
      document.warn("specularTexture", "The textures of KHR_materials_specular are ignored; its factors are used.");
    }
  }
}

AlphaMode alpha_mode(const JsonObject& object) {
  const std::string mode = object.text("alphaMode", "OPAQUE");
  if (mode == "OPAQUE") return AlphaMode::opaque;
  if (mode == "MASK") return AlphaMode::mask;
  if (mode == "BLEND") return AlphaMode::blend;
  fail("VALUE_NOT_IN_LIST", object.label(), "has the unknown alphaMode \"" + printable(mode) + "\"");
}

void read_emission(const JsonObject& object, TextureReader& textures, Material& material) {
  const Vec3 factor = vec3(non_negative<3>(object, "emissiveFactor", {0, 0, 0}));
  float strength = 1;
  if (const std::optional<JsonObject> extension = object.extension("KHR_materials_emissive_strength")) {
    strength = extension->number("emissiveStrength", 1);
    if (strength < 0) fail("VALUE_NOT_IN_RANGE", extension->label(), "property \"emissiveStrength\" is negative");
  }
  material.emission = factor * strength;
  material.emissive_texture = textures.slot(object, "emissiveTexture", true);
}

// KHR_materials_unlit: the base colour is the radiance, whatever light there is. It goes where emission goes; what
// reflects becomes black, and its alpha stays where alpha is read.
void make_unlit(Material& material) {
  material.unlit = true;
  material.emission = {material.base_colour.x, material.base_colour.y, material.base_colour.z};
  material.emissive_texture = material.base_colour_texture;
  material.base_colour = {0, 0, 0, material.base_colour.w};
  material.metallic = 0;
  material.roughness = 1;
  material.metallic_roughness_texture = {};
  material.normal_texture = {};
  material.dielectric_f0 = {0, 0, 0};
  material.dielectric_f90 = 0;
}

}  // namespace

Material default_material() {
  Material material;
  material.name = "default";
  return material;
}

Material read_material(Document& document, TextureReader& textures, std::size_t index) {
  const JsonObject object = document.element(kMaterials, index);
  Material material;
  material.name = object.text("name");
  const std::optional<JsonObject> metallic_roughness = object.object("pbrMetallicRoughness");
  if (metallic_roughness) read_metallic_roughness(*metallic_roughness, textures, material);
  read_dielectric_reflection(object, document, material);
  if (const auto extension = object.extension("KHR_materials_pbrSpecularGlossiness");
      extension && !metallic_roughness) {
    read_specular_glossiness(*extension, document, textures, material);
  }
  if (const std::optional<JsonObject> normal = object.object("normalTexture")) {
    material.normal_texture = textures.slot(object, "normalTexture", false);
    material.normal_scale = normal->number("scale", 1);
  }
  read_emission(object, textures, material);
  material.alpha_mode = alpha_mode(object);
  material.alpha_cutoff = object.number("alphaCutoff", 0.5f);
  material.double_sided = object.boolean("doubleSided", false);
  if (object.extension("KHR_materials_unlit")) make_unlit(material);
  return material;
}

}  // namespace luciole::gltf
