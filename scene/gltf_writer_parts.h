// SPDX-License-Identifier: Apache-2.0
// The parts of a glTF document as they are collected; inner to the writer (gltf_writer.h).
#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace luciole::gltf {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

// The binary buffer and the views and accessors into it. Every view starts at a multiple of four bytes.
class BufferWriter {
 public:
  enum class Target : int { none = 0, vertices = 34962, indices = 34963 };

  std::size_t add_view(const void* data, std::size_t size, Target target);
  std::size_t add_vectors(const std::vector<Vec2>& values);
  std::size_t add_vectors(const std::vector<Vec3>& values, bool with_bounds);
  std::size_t add_vectors(const std::vector<Vec4>& values);
  // Numbers of an animation, so many per key; of one, times, which the format wants with their bounds.
  std::size_t add_track(const std::vector<float>& values, std::size_t components);
  std::size_t add_indices(const std::vector<std::uint32_t>& indices);

  const Bytes& bytes() const { return bytes_; }
  const Json& views() const { return views_; }
  const Json& accessors() const { return accessors_; }

 private:
  std::size_t add_accessor(std::size_t view, int component_type, std::size_t count, const char* type);

  Bytes bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

// Names that are given once; a second of the same name becomes "name 2".
class UniqueNames {
 public:
  std::string give(const std::string& wanted, const std::string& fallback);

 private:
  std::set<std::string> given_;
};

using ExtensionNames = std::set<std::string>;  // what the document uses

Json material_json(const Material& material, ExtensionNames& used);
Json sampler_json(const Texture& texture);
Json light_json(const PunctualLight& light);

// A node's rotation [x y z w] whose axes are the given ones.
Json rotation_json(Vec3 x, Vec3 y, Vec3 z);
// ... whose -Z is `direction`.
Json rotation_towards(Vec3 direction);

// The finest level of an image as a PNG file; nothing if libpng fails. Alpha is kept where there is some.
std::optional<Bytes> encode_png(const MipImage& image);

}  // namespace luciole::gltf
