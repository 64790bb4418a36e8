// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_document.h"

#include <algorithm>
#include <utility>

#include "scene/file_fault.h"
#include "scene/glb_container.h"
#include "scene/uri.h"

namespace luciole::gltf {
namespace {

// What this reader honours.
constexpr const char* kHonoured[] = {"KHR_texture_transform", "KHR_materials_emissive_strength",
                                     "KHR_lights_punctual",   "KHR_materials_specular",
                                     "KHR_materials_ior",     "EXT_mesh_gpu_instancing",
                                     "KHR_mesh_quantization", "KHR_materials_pbrSpecularGlossiness",
                                     "KHR_materials_unlit"};

// What may be required and is left out all the same: the geometry is complete without it, only the look is plainer.
constexpr const char* kLooksOnly[] = {
    "KHR_materials_variants",    "KHR_materials_transmission", "KHR_materials_volume",
    "KHR_materials_clearcoat",   "KHR_materials_sheen",        "KHR_materials_anisotropy",
    "KHR_materials_iridescence", "KHR_materials_dispersion",   "KHR_materials_diffuse_transmission"};

template <std::size_t N>
bool contains(const char* const (&names)[N], const std::string& name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

std::vector<std::string> strings_of(const JsonObject& object, const char* property) {
  std::vector<std::string> result;
  if (const Json* values = object.array(property)) {
    for (const Json& value : *values) {
      if (!value.is_string()) {
        fail("TYPE_MISMATCH", object.label(), std::string("property \"") + property + "\" is not an array of strings");
      }
      result.push_back(value.get<std::string>());
    }
  }
  return result;
}

}  // namespace

Document::Document(std::span<const std::uint8_t> file, bool must_be_glb, FileReader files, const LoadLimits& limits)
    : files_(std::move(files)), limits_(limits) {
  std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  if (must_be_glb || is_glb(file)) {
    const GlbChunks chunks = split_glb(file);
    text = chunks.json;
    glb_binary_ = chunks.binary;
  }
  json_ = parse_json(text);
  root_.emplace(json_, "document");
  check_asset();
  check_extensions();
}

void Document::check_asset() const {
  const std::optional<JsonObject> asset = root_->object("asset");
  if (!asset) fail("UNDEFINED_PROPERTY", "document", "property \"asset\" is missing");
  const std::string version = asset->text("version");
  if (version.empty()) fail("UNDEFINED_PROPERTY", asset->label(), "property \"version\" is missing");
  if (!version.starts_with("2.")) {
    fail("UNKNOWN_ASSET_MAJOR_VERSION", asset->label(), "is glTF version " + printable(version) + ", not 2");
  }
  const std::string least = asset->text("minVersion", "2.0");
  if (least != "2.0") {
    fail("UNKNOWN_ASSET_MINOR_VERSION", asset->label(), "needs a reader for version " + printable(least));
  }
}

void Document::check_extensions() {
  for (const std::string& name : strings_of(*root_, "extensionsRequired")) {
    if (!contains(kHonoured, name) && !contains(kLooksOnly, name)) {
      fail("UNSUPPORTED_EXTENSION", "document",
           "requires the extension " + printable(name) + ", which is not supported");
    }
  }
  for (const std::string& name : strings_of(*root_, "extensionsUsed")) {
    if (!contains(kHonoured, name)) warn(name, "The extension " + printable(name) + " is ignored.");
  }
}

std::size_t Document::count(Kind kind) const {
  const Json* elements = root_->array(kind.property);
  return elements == nullptr ? 0 : elements->size();
}

JsonObject Document::element(Kind kind, std::size_t index) const {
  const Json& value = (*root_->array(kind.property))[index];
  std::string label = kind.singular + (" " + std::to_string(index));
  if (value.is_object()) {
    const auto name = value.find("name");
    if (name != value.end() && name->is_string() && !name->get_ref<const std::string&>().empty()) {
      label += " \"" + printable(name->get_ref<const std::string&>()) + "\"";
    }
  }
  return JsonObject(value, std::move(label));
}

std::span<const std::uint8_t> Document::buffer(std::size_t index) {
  const JsonObject object = element(kBuffers, index);
  const std::uint64_t length = object.required_whole("byteLength");
  const auto cut = [&](std::span<const std::uint8_t> bytes) {
    if (bytes.size() < length) {
      fail("BUFFER_BYTE_LENGTH_MISMATCH", object.label(),
           "needs " + std::to_string(length) + " bytes but has " + std::to_string(bytes.size()));
    }
    return bytes.first(length);
  };
  if (!object.has("uri")) {
    if (index == 0 && glb_binary_) return cut(*glb_binary_);
    fail("BUFFER_MISSING_GLB_DATA", object.label(), "has neither a URI nor a binary GLB chunk");
  }
  const auto known = buffers_.find(index);
  if (known != buffers_.end()) return cut(known->second);
  Bytes bytes = resolve_uri(object.text("uri"), object.label(), files_);
  buffer_bytes_ += bytes.size();
  if (buffer_bytes_ > limits_.buffer_bytes)
    fail("VALUE_NOT_IN_RANGE", object.label(), "all buffers are too large together");
  return cut(buffers_.emplace(index, std::move(bytes)).first->second);
}

BufferView Document::buffer_view(std::size_t index) {
  const JsonObject object = element(kBufferViews, index);
  const std::size_t buffer_index = object.required_reference("buffer", count(kBuffers));
  const std::uint64_t offset = object.whole("byteOffset", 0), length = object.required_whole("byteLength");
  if (length == 0) fail("VALUE_NOT_IN_RANGE", object.label(), "its byteLength is zero");
  const std::span<const std::uint8_t> bytes = buffer(buffer_index);
  // Both are at most 2^53 (JsonObject::whole), so that the sum cannot wrap.
  if (offset + length > bytes.size()) {
    fail("BUFFER_VIEW_TOO_LONG", object.label(),
         "ends at byte " + std::to_string(offset + length) + " of buffer " + std::to_string(buffer_index) +
             ", which has " + std::to_string(bytes.size()));
  }
  const std::uint64_t stride = object.whole("byteStride", 0);
  if (object.has("byteStride") && (stride < 4 || stride > 252 || stride % 4 != 0)) {
    fail("BUFFER_VIEW_INVALID_BYTE_STRIDE", object.label(),
         "its byteStride " + std::to_string(stride) + " is not a multiple of 4 from 4 to 252");
  }
  return {bytes.subspan(offset, length), static_cast<std::uint32_t>(stride), object.label()};
}

std::span<const std::uint8_t> Document::image_bytes(std::size_t image, Bytes& storage) {
  const JsonObject object = element(kImages, image);
  if (object.has("bufferView") == object.has("uri")) {
    fail("ONE_OF_MISMATCH", object.label(), "needs either a URI or a bufferView");
  }
  if (const std::optional<std::size_t> view = object.reference("bufferView", count(kBufferViews))) {
    return buffer_view(*view).bytes;
  }
  storage = resolve_uri(object.text("uri"), object.label(), files_);
  return storage;
}

void Document::warn(const std::string& key, const std::string& sentence) {
  if (warned_.insert(key).second) warnings_.push_back(sentence);
}

void Document::charge_vertices(std::uint64_t vertices, const std::string& object) {
  vertices_ += vertices;
  if (vertices > limits_.vertices || vertices_ > limits_.vertices) {
    fail("VALUE_NOT_IN_RANGE", object,
         "the scene has more than " + std::to_string(limits_.vertices) + " vertices or indices");
  }
}

}  // namespace luciole::gltf
