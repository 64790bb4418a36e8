// SPDX-License-Identifier: Apache-2.0
// Small glTF files made in memory, for tests.
#pragma once
#include <png.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/load_scene.h"

namespace luciole::test {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

inline std::string base64(const Bytes& bytes) {
  static constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kAlphabet[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

inline std::string data_uri(const std::string& media_type, const Bytes& bytes) {
  return "data:" + media_type + ";base64," + base64(bytes);
}

// An 8-bit RGBA image as a PNG file.
inline Bytes png_file(std::uint32_t width, std::uint32_t height, const Bytes& rgba) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, rgba.data(), 0, nullptr);
  Bytes file(size);
  png_image_write_to_memory(&image, file.data(), &size, 0, rgba.data(), 0, nullptr);
  file.resize(size);
  return file;
}

// One unit square in the plane z = 0, seen from +z; (0,0) of the image is its top left corner. Accessors: 0 positions,
// 1 texture coordinates, 2 normals, 3 indices (16 bits).
inline Json square_file() {
  const std::vector<float> values = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,   // positions
                                     0, 1, 1, 1, 1, 0, 0, 0,               // texture coordinates
                                     0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};  // normals
  const std::vector<std::uint16_t> indices = {0, 1, 2, 0, 2, 3};
  Bytes bytes(values.size() * 4 + indices.size() * 2);
  std::memcpy(bytes.data(), values.data(), values.size() * 4);
  std::memcpy(bytes.data() + values.size() * 4, indices.data(), indices.size() * 2);
  const std::size_t size = bytes.size();
  Json file;
  file["asset"] = {{"version", "2.0"}};
  file["scene"] = 0;
  file["scenes"] = {{{"nodes", {0}}}};
  file["nodes"] = {{{"mesh", 0}}};
  file["buffers"] = {{{"byteLength", size}, {"uri", data_uri("application/octet-stream", bytes)}}};
  file["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
                         {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 32}},
                         {{"buffer", 0}, {"byteOffset", 80}, {"byteLength", 48}},
                         {{"buffer", 0}, {"byteOffset", 128}, {"byteLength", 12}}};
  file["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
                       {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
                       {{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
                       {{"bufferView", 3}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
  file["materials"] = {{{"name", "paint"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
  file["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"NORMAL", 2}}}, {"indices", 3}, {"material", 0}}}}}};
  return file;
}

// Adds an image and a texture that uses it; returns the texture's index.
inline std::size_t add_texture(Json& file, const Bytes& png, const Json& sampler = Json::object()) {
  file["images"].push_back({{"uri", data_uri("image/png", png)}});
  file["samplers"].push_back(sampler);
  file["textures"].push_back({{"source", file["images"].size() - 1}, {"sampler", file["samplers"].size() - 1}});
  return file["textures"].size() - 1;
}

inline Result<Scene> load(const std::string& text, const LoadLimits& limits = {}) {
  return load_gltf({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "made.gltf", no_files(), limits);
}
inline Result<Scene> load(const Json& file, const LoadLimits& limits = {}) { return load(file.dump(), limits); }

// The error's sentence, or "" if the file loads.
inline std::string fault_of(const Json& file, const LoadLimits& limits = {}) {
  const Result<Scene> scene = load(file, limits);
  return scene ? "" : scene.error().message;
}

}  // namespace luciole::test
