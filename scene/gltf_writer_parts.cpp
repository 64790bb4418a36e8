// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_writer_parts.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace luciole::gltf {
namespace {

constexpr int kFloat = 5126, kUnsignedInt = 5125;

Json numbers(std::initializer_list<float> values) {
  Json list = Json::array();
  for (const float value : values) list.push_back(value);
  return list;
}
Json json_of(Vec3 v) { return numbers({v.x, v.y, v.z}); }

float largest(Vec3 v) { return std::max({v.x, v.y, v.z}); }

// KHR_texture_transform takes scale and rotation: the matrix is that of a reader's slot, rotation * scale.
Json slot_json(const TextureSlot& slot, ExtensionNames& used) {
  Json json = {{"index", slot.texture}};
  if (slot.uv_set != 0) json["texCoord"] = slot.uv_set;
  const bool plain =
      slot.a == 1 && slot.b == 0 && slot.c == 0 && slot.d == 1 && slot.offset.x == 0 && slot.offset.y == 0;
  if (plain) return json;
  const float angle = std::atan2(-slot.c, slot.a), scale_u = std::hypot(slot.a, slot.c);
  const float scale_v = slot.b * std::sin(angle) + slot.d * std::cos(angle);
  json["extensions"]["KHR_texture_transform"] = {
      {"offset", numbers({slot.offset.x, slot.offset.y})}, {"rotation", angle}, {"scale", numbers({scale_u, scale_v})}};
  used.insert("KHR_texture_transform");
  return json;
}

void add_slot(Json& parent, const char* name, const TextureSlot& slot, ExtensionNames& used) {
  if (slot.texture >= 0) parent[name] = slot_json(slot, used);
}

void add_emission(Json& json, const Material& material, ExtensionNames& used) {
  const float strength = largest(material.emission);
  if (strength > 0) {
    json["emissiveFactor"] = json_of(strength > 1 ? material.emission / strength : material.emission);
  }
  if (strength > 1) {
    json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
    used.insert("KHR_materials_emissive_strength");
  }
  add_slot(json, "emissiveTexture", material.emissive_texture, used);
}

// F0 = min(((ior - 1) / (ior + 1))^2 * colour, 1) * specular, F90 = specular. A grey F0 at full specular is an index of
// refraction; anything else keeps the index 1.5 and tints it.
void add_dielectric_reflection(Json& json, const Material& material, ExtensionNames& used) {
  const Vec3 f0 = material.dielectric_f0;
  constexpr float kF0OfIndex1_5 = 0.04f;
  const bool grey = f0.x == f0.y && f0.y == f0.z;
  if (material.dielectric_f90 == 1 && grey && f0.x == kF0OfIndex1_5) return;
  if (material.dielectric_f90 == 1 && grey && f0.x < 1) {
    const double root = std::sqrt(static_cast<double>(f0.x));
    json["extensions"]["KHR_materials_ior"] = {{"ior", (1 + root) / (1 - root)}};
    used.insert("KHR_materials_ior");
    return;
  }
  Json& specular = json["extensions"]["KHR_materials_specular"];
  specular["specularFactor"] = material.dielectric_f90;
  const float whole = kF0OfIndex1_5 * material.dielectric_f90;
  if (whole > 0) specular["specularColorFactor"] = json_of(f0 / whole);
  used.insert("KHR_materials_specular");
}

void append_png_bytes(png_structp png, png_bytep data, png_size_t size) {
  auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
  bytes.insert(bytes.end(), data, data + size);
}

}  // namespace

std::size_t BufferWriter::add_view(const void* data, std::size_t size, Target target) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
  if (target != Target::none) view["target"] = static_cast<int>(target);
  const auto* first = static_cast<const std::uint8_t*>(data);
  bytes_.insert(bytes_.end(), first, first + size);
  views_.push_back(std::move(view));
  return views_.size() - 1;
}

std::size_t BufferWriter::add_accessor(std::size_t view, int component_type, std::size_t count, const char* type) {
  accessors_.push_back({{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
  return accessors_.size() - 1;
}

std::size_t BufferWriter::add_vectors(const std::vector<Vec2>& values) {
  static_assert(sizeof(Vec2) == 8 && sizeof(Vec3) == 12 && sizeof(Vec4) == 16);
  return add_accessor(add_view(values.data(), values.size() * sizeof(Vec2), Target::vertices), kFloat, values.size(),
                      "VEC2");
}

std::size_t BufferWriter::add_vectors(const std::vector<Vec3>& values, bool with_bounds) {
  const std::size_t index = add_accessor(add_view(values.data(), values.size() * sizeof(Vec3), Target::vertices),
                                         kFloat, values.size(), "VEC3");
  if (!with_bounds) return index;
  Bounds bounds;
  for (const Vec3 value : values) bounds.grow(value);
  accessors_[index]["min"] = json_of(bounds.low);
  accessors_[index]["max"] = json_of(bounds.high);
  return index;
}

std::size_t BufferWriter::add_vectors(const std::vector<Vec4>& values) {
  return add_accessor(add_view(values.data(), values.size() * sizeof(Vec4), Target::vertices), kFloat, values.size(),
                      "VEC4");
}

std::size_t BufferWriter::add_track(const std::vector<float>& values, std::size_t components) {
  const std::size_t index =
      add_accessor(add_view(values.data(), values.size() * sizeof(float), Target::none), kFloat,
                   values.size() / components, components == 1 ? "SCALAR" : (components == 3 ? "VEC3" : "VEC4"));
  if (components > 1) return index;
  accessors_[index]["min"] = numbers({values.front()});
  accessors_[index]["max"] = numbers({values.back()});
  return index;
}

std::size_t BufferWriter::add_indices(const std::vector<std::uint32_t>& indices) {
  return add_accessor(add_view(indices.data(), indices.size() * sizeof(std::uint32_t), Target::indices), kUnsignedInt,
                      indices.size(), "SCALAR");
}

std::string UniqueNames::give(const std::string& wanted, const std::string& fallback) {
  const std::string base = wanted.empty() ? fallback : wanted;
  std::string name = base;
  for (int number = 2; !given_.insert(name).second; ++number) name = base + " " + std::to_string(number);
  return name;
}

Json material_json(const Material& material, ExtensionNames& used) {
  Json json;
  Json& surface = json["pbrMetallicRoughness"];
  const Vec4 base = material.base_colour;
  surface["baseColorFactor"] = numbers({base.x, base.y, base.z, base.w});
  surface["metallicFactor"] = material.metallic;
  surface["roughnessFactor"] = material.roughness;
  add_slot(surface, "baseColorTexture", material.base_colour_texture, used);
  add_slot(surface, "metallicRoughnessTexture", material.metallic_roughness_texture, used);
  if (material.normal_texture.texture >= 0) {
    json["normalTexture"] = slot_json(material.normal_texture, used);
    json["normalTexture"]["scale"] = material.normal_scale;
  }
  add_emission(json, material, used);
  add_dielectric_reflection(json, material, used);
  if (material.alpha_mode == AlphaMode::mask) {
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = material.alpha_cutoff;
  }
  if (material.alpha_mode == AlphaMode::blend) json["alphaMode"] = "BLEND";
  if (material.double_sided) json["doubleSided"] = true;
  return json;
}

Json sampler_json(const Texture& texture) {
  const auto wrap = [](Wrap mode) {
    return mode == Wrap::repeat ? 10497 : (mode == Wrap::mirrored_repeat ? 33648 : 33071);
  };
  int minify = texture.minify_linear ? 9729 : 9728;
  if (texture.mip_filter == MipFilter::nearest) minify = texture.minify_linear ? 9985 : 9984;
  if (texture.mip_filter == MipFilter::linear) minify = texture.minify_linear ? 9987 : 9986;
  return {{"magFilter", texture.magnify_linear ? 9729 : 9728},
          {"minFilter", minify},
          {"wrapS", wrap(texture.wrap_u)},
          {"wrapT", wrap(texture.wrap_v)}};
}

Json light_json(const PunctualLight& light) {
  const float strength = largest(light.intensity);
  Json json = {{"intensity", strength}};
  if (strength > 0) json["color"] = json_of(light.intensity / strength);
  switch (light.kind) {
    case PunctualLight::Kind::point:
      json["type"] = "point";
      break;
    case PunctualLight::Kind::directional:
      json["type"] = "directional";
      break;
    case PunctualLight::Kind::spot:
      json["type"] = "spot";
      // In double: the arc cosine of a float near 1 would lose half its digits.
      json["spot"] = {{"innerConeAngle", std::acos(std::min(1.0, static_cast<double>(light.cos_inner)))},
                      {"outerConeAngle", std::acos(std::min(1.0, static_cast<double>(light.cos_outer)))}};
      break;
  }
  return json;
}

Json rotation_json(Vec3 x, Vec3 y, Vec3 z) {
  // Of the four forms of the quaternion of a rotation matrix, the one whose divisor is largest.
  const double trace = static_cast<double>(x.x) + y.y + z.z;
  double q[4];  // x y z w
  if (trace > 0) {
    const double s = 2 * std::sqrt(1 + trace);
    q[0] = (y.z - z.y) / s, q[1] = (z.x - x.z) / s, q[2] = (x.y - y.x) / s, q[3] = s / 4;
  } else if (x.x >= y.y && x.x >= z.z) {
    const double s = 2 * std::sqrt(1.0 + x.x - y.y - z.z);
    q[0] = s / 4, q[1] = (x.y + y.x) / s, q[2] = (z.x + x.z) / s, q[3] = (y.z - z.y) / s;
  } else if (y.y >= z.z) {
    const double s = 2 * std::sqrt(1.0 + y.y - x.x - z.z);
    q[0] = (x.y + y.x) / s, q[1] = s / 4, q[2] = (y.z + z.y) / s, q[3] = (z.x - x.z) / s;
  } else {
    const double s = 2 * std::sqrt(1.0 + z.z - x.x - y.y);
    q[0] = (z.x + x.z) / s, q[1] = (y.z + z.y) / s, q[2] = s / 4, q[3] = (x.y - y.x) / s;
  }
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
}

Json rotation_towards(Vec3 direction) {
  const Camera frame = look_at({0, 0, 0}, direction, 1);
  return rotation_json(frame.right, frame.up, -frame.forward);
}

std::optional<Bytes> encode_png(const MipImage& image) {
  const MipImage::Level& level = image.levels.front();
  const std::size_t channels = image.has_alpha ? 4 : 3;
  Bytes row(channels * level.width), file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return std::nullopt;
  }
  png_set_write_fn(png, &file, append_png_bytes, nullptr);
  png_set_IHDR(png, info, level.width, level.height, 8, channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (std::size_t y = 0; y < level.height; ++y) {
    for (std::size_t x = 0; x < level.width; ++x) {
      std::memcpy(&row[channels * x], image.texels(level) + 4 * (y * level.width + x), channels);
    }
    png_write_row(png, row.data());
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return file;
}

}  // namespace luciole::gltf
