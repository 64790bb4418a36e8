// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_check.h"

#include <optional>
#include <string>

#include "scene/decode_image.h"
#include "scene/file_fault.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_animation.h"
#include "scene/gltf_lights_cameras.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_primitives.h"
#include "scene/gltf_textures.h"

namespace luciole::gltf {
namespace {

// A buffer without URI and GLB chunk is allowed as long as nothing asks for its bytes; so is a view into it.
bool has_bytes(Document& document, std::size_t buffer) {
  return document.element(kBuffers, buffer).has("uri") || (buffer == 0 && document.has_glb_binary());
}

void check_buffers(Document& document) {
  for (std::size_t i = 0; i < document.count(kBuffers); ++i) {
    const JsonObject object = document.element(kBuffers, i);
    if (object.required_whole("byteLength") == 0) fail("VALUE_NOT_IN_RANGE", object.label(), "its byteLength is zero");
    if (has_bytes(document, i)) document.buffer(i);
  }
  for (std::size_t i = 0; i < document.count(kBufferViews); ++i) {
    const JsonObject object = document.element(kBufferViews, i);
    if (has_bytes(document, object.required_reference("buffer", document.count(kBuffers)))) document.buffer_view(i);
  }
}

// Whether every view that the accessor names has bytes to look at.
bool can_be_read(Document& document, const JsonObject& accessor) {
  const auto readable = [&](const JsonObject& user) {
    const std::optional<std::size_t> view = user.reference("bufferView", document.count(kBufferViews));
    if (!view) return true;
    return has_bytes(document,
                     document.element(kBufferViews, *view).required_reference("buffer", document.count(kBuffers)));
  };
  if (!readable(accessor)) return false;
  const std::optional<JsonObject> sparse = accessor.object("sparse");
  if (!sparse) return true;
  const std::optional<JsonObject> indices = sparse->object("indices"), values = sparse->object("values");
  return (!indices || readable(*indices)) && (!values || readable(*values));
}

void check_accessors(Document& document) {
  for (std::size_t i = 0; i < document.count(kAccessors); ++i) {
    const JsonObject object = document.element(kAccessors, i);
    const std::string type = object.text("type");
    if (type == "MAT2" || type == "MAT3") continue;
    accessor_shape(document, i);
    if (can_be_read(document, object)) check_accessor_bytes(document, i);
  }
}

void check_images_and_textures(Document& document) {
  for (std::size_t i = 0; i < document.count(kImages); ++i) {
    const JsonObject object = document.element(kImages, i);
    const std::optional<std::size_t> view = object.reference("bufferView", document.count(kBufferViews));
    if (view && document.buffer_view(*view).stride != 0) {
      fail("IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE", object.label(), "its bytes are strided");
    }
    Bytes storage;
    document.image_bytes(i, storage);
  }
  TextureReader textures(document);
  for (std::size_t i = 0; i < document.count(kSamplers); ++i) textures.check_sampler(i);
  for (std::size_t i = 0; i < document.count(kTextures); ++i) {
    document.element(kTextures, i).object("extensions");
    textures.texture(i, false);
  }
  for (std::size_t i = 0; i < document.count(kMaterials); ++i) {
    read_material(document, textures, i);
    textures.slot(document.element(kMaterials, i), "occlusionTexture", false);
  }
}

void check_skins(Document& document) {
  for (std::size_t i = 0; i < document.count(kSkins); ++i) {
    const JsonObject skin = document.element(kSkins, i);
    const std::size_t joints = skin.references("joints", document.count(kNodes)).size();
    if (joints == 0) fail("EMPTY_ENTITY", skin.label(), "has no joints");
    skin.reference("skeleton", document.count(kNodes));
    const std::optional<std::size_t> matrices = skin.reference("inverseBindMatrices", document.count(kAccessors));
    if (!matrices) continue;
    const AccessorShape shape = accessor_shape(document, *matrices);
    if (shape.components != 16 || shape.component_type != ComponentType::float32) {
      fail("SKIN_IBM_INVALID_FORMAT", skin.label(), shape.label + " does not hold matrices of floats");
    }
    if (shape.count < joints)
      fail("INVALID_IBM_ACCESSOR_COUNT", skin.label(), shape.label + " has fewer matrices than joints");
  }
}

void check_scenes_and_nodes(Document& document) {
  for (std::size_t i = 0; i < document.count(kScenes); ++i) {
    document.element(kScenes, i).references("nodes", document.count(kNodes));
  }
  for (std::size_t i = 0; i < document.count(kNodes); ++i) {
    const JsonObject node = document.element(kNodes, i);
    node.reference("mesh", document.count(kMeshes));
    node.reference("skin", document.count(kSkins));
    node.reference("camera", document.count(kCameras));
    if (const std::optional<JsonObject> light = node.extension("KHR_lights_punctual")) {
      light->required_reference("light", light_count(document));
    }
  }
}

}  // namespace

void check_the_rest(Document& document, const std::map<std::size_t, std::vector<Mesh>>& read_meshes) {
  check_scenes_and_nodes(document);
  check_buffers(document);
  check_accessors(document);
  check_images_and_textures(document);
  for (std::size_t i = 0; i < document.count(kMeshes); ++i) {
    if (!read_meshes.contains(i)) read_mesh(document, i);
  }
  for (std::size_t i = 0; i < document.count(kCameras); ++i) read_camera(document, i);
  for (std::size_t i = 0; i < light_count(document); ++i) read_light(document, i);
  check_skins(document);
}

}  // namespace luciole::gltf
