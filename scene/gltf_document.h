// SPDX-License-Identifier: Apache-2.0
// A glTF 2.0 document while it is being read: its JSON, its bytes, what it has used of its limits, its warnings.
// Everything is checked where it is used; gltf_check.h looks at the rest.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/file_access.h"
#include "scene/json_object.h"

namespace luciole::gltf {

// A top-level array and what one of its elements is called in messages.
struct Kind {
  const char* property;
  const char* singular;
};
inline constexpr Kind kAccessors{"accessors", "accessor"}, kBuffers{"buffers", "buffer"},
    kBufferViews{"bufferViews", "bufferView"}, kCameras{"cameras", "camera"}, kImages{"images", "image"},
    kMaterials{"materials", "material"}, kMeshes{"meshes", "mesh"}, kNodes{"nodes", "node"},
    kSamplers{"samplers", "sampler"}, kScenes{"scenes", "scene"}, kSkins{"skins", "skin"},
    kAnimations{"animations", "animation"}, kTextures{"textures", "texture"};

struct BufferView {
  std::span<const std::uint8_t> bytes;
  std::uint32_t stride = 0;  // [byte]; 0: tightly packed
  std::string label;
};

class Document {
 public:
  // `file` is the text or (told by its first bytes, or demanded) the GLB container; it must outlive the document.
  Document(std::span<const std::uint8_t> file, bool must_be_glb, FileReader files, const LoadLimits& limits);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const JsonObject& root() const { return *root_; }
  std::size_t count(Kind kind) const;
  JsonObject element(Kind kind, std::size_t index) const;

  std::span<const std::uint8_t> buffer(std::size_t index);
  bool has_glb_binary() const { return glb_binary_.has_value(); }
  BufferView buffer_view(std::size_t index);
  // The encoded bytes of an image, wherever they are. `storage` keeps them if they belong to nobody else.
  std::span<const std::uint8_t> image_bytes(std::size_t image, Bytes& storage);

  // Adds a sentence once per key.
  void warn(const std::string& key, const std::string& sentence);
  std::vector<std::string> take_warnings() { return std::move(warnings_); }

  // Counts towards the limit and fails beyond it.
  void charge_vertices(std::uint64_t vertices, const std::string& object);
  const LoadLimits& limits() const { return limits_; }

 private:
  void check_asset() const;
  void check_extensions();

  Json json_;
  std::optional<JsonObject> root_;
  std::optional<std::span<const std::uint8_t>> glb_binary_;
  FileReader files_;
  LoadLimits limits_;
  std::map<std::size_t, Bytes> buffers_;  // those that were needed
  std::uint64_t buffer_bytes_ = 0, vertices_ = 0;
  std::set<std::string> warned_;
  std::vector<std::string> warnings_;
};

}  // namespace luciole::gltf
