// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_scene.h"

#include <map>
#include <optional>
#include <utility>

#include "scene/file_fault.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_animation.h"
#include "scene/gltf_check.h"
#include "scene/gltf_lights_cameras.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_primitives.h"
#include "scene/gltf_textures.h"
#include "scene/mesh_finish.h"

namespace luciole::gltf {
namespace {

// EXT_mesh_gpu_instancing: a map per instance, inside the node's. Empty if the node is drawn once.
std::vector<Affine> read_instances(Document& document, const JsonObject& node) {
  const std::optional<JsonObject> extension = node.extension("EXT_mesh_gpu_instancing");
  if (!extension) return {};
  const std::optional<JsonObject> attributes = extension->object("attributes");
  if (!attributes) fail("UNDEFINED_PROPERTY", extension->label(), "property \"attributes\" is missing");
  std::optional<std::size_t> count;
  const auto read = [&](const char* name, std::uint32_t components) -> std::vector<float> {
    const std::optional<std::size_t> accessor = attributes->reference(name, document.count(kAccessors));
    if (!accessor) return {};
    const AccessorShape shape = accessor_shape(document, *accessor);
    if (shape.components != components || (count && *count != shape.count)) {
      fail("EXT_MESH_GPU_INSTANCING", attributes->label(), std::string(name) + " does not fit: " + shape.label);
    }
    count = shape.count;
    document.charge_vertices(shape.count, shape.label);
    return read_floats(document, *accessor);
  };
  const std::vector<float> t = read("TRANSLATION", 3), r = read("ROTATION", 4), s = read("SCALE", 3);
  std::vector<Affine> instances(count.value_or(0));
  for (std::size_t i = 0; i < instances.size(); ++i) {
    instances[i] =
        affine_from_parts(t.empty() ? Vec3(0, 0, 0) : Vec3(t[i * 3], t[i * 3 + 1], t[i * 3 + 2]),
                          r.empty() ? Vec4(0, 0, 0, 1) : Vec4(r[i * 4], r[i * 4 + 1], r[i * 4 + 2], r[i * 4 + 3]),
                          s.empty() ? Vec3(1, 1, 1) : Vec3(s[i * 3], s[i * 3 + 1], s[i * 3 + 2]), extension->label());
  }
  return instances;
}

class SceneReader {
 public:
  SceneReader(std::span<const std::uint8_t> file, bool must_be_glb, FileReader files, const LoadLimits& limits)
      : document_(file, must_be_glb, std::move(files), limits), textures_(document_), motion_(document_) {}

  Scene read() {
    for_each_node(document_, [this](const NodeVisit& node) { visit(node); });
    scene_.animation = motion_.take();
    check_the_rest(document_, meshes_);
    meshes_.clear();
    if (scene_.materials.empty()) scene_.materials.push_back(default_material());
    scene_.textures = textures_.decoded_textures();
    scene_.warnings = document_.take_warnings();
    return std::move(scene_);
  }

 private:
  void visit(const NodeVisit& visited) {
    const JsonObject node = document_.element(kNodes, visited.node);
    const std::optional<std::uint32_t> moving = motion_.visit(visited);
    const std::size_t lights = scene_.lights.size(), cameras = scene_.cameras.size();
    read_light_of(document_, node, visited.world_from_node, scene_);
    read_camera_of(document_, node, visited.world_from_node, scene_);
    if (moving && scene_.lights.size() > lights) motion_.add(MovingLight{static_cast<std::uint32_t>(lights), *moving});
    if (moving && scene_.cameras.size() > cameras) {
      motion_.add(MovingCamera{static_cast<std::uint32_t>(cameras), *moving});
    }
    const std::optional<std::size_t> mesh = node.reference("mesh", document_.count(kMeshes));
    if (!mesh) return;
    if (node.has("skin")) document_.warn("skins", "Skins are ignored: meshes keep their bind pose.");
    if (!node.extension("EXT_mesh_gpu_instancing")) {
      return place({*mesh, visited.world_from_node, Affine{}, moving}, node);
    }
    for (const Affine& node_from_instance : read_instances(document_, node)) {
      place({*mesh, visited.world_from_node, node_from_instance, moving}, node);
    }
  }

  struct Placement {
    std::size_t mesh;
    Affine world_from_node, node_from_mesh;
    std::optional<std::uint32_t> moving;
  };

  void place(const Placement& where, const JsonObject& node) {
    for (const Mesh& primitive : mesh(where.mesh)) {
      document_.charge_vertices(primitive.positions.size() + primitive.indices.size(), node.label());
      Mesh placed = primitive;
      if (placed.name.empty()) placed.name = node.text("name");
      if (where.moving) {
        motion_.add(
            MovingMesh{static_cast<std::uint32_t>(scene_.meshes.size()), *where.moving, where.node_from_mesh, placed});
      }
      transform_mesh(placed, where.world_from_node * where.node_from_mesh, node.label());
      scene_.meshes.push_back(std::move(placed));
    }
  }

  // The primitives of a mesh in its own space, ready but for the transform. Read once, however many nodes show it.
  const std::vector<Mesh>& mesh(std::size_t index) {
    const auto known = meshes_.find(index);
    if (known != meshes_.end()) return known->second;
    std::vector<Mesh> primitives = read_mesh(document_, index);
    for (Mesh& primitive : primitives) {
      primitive.material = material(primitive.material);
      if (!primitive.colours.empty() && scene_.materials[primitive.material].unlit) {
        document_.warn("unlit COLOR_0", "The vertex colours of unlit materials are ignored.");
      }
      drop_unused_vertices(primitive);
      normalise_normals(primitive);
      const TextureSlot& normal_map = scene_.materials[primitive.material].normal_texture;
      if (normal_map.texture < 0) {
        primitive.tangents.clear();
      } else if (primitive.tangents.empty()) {
        add_tangents(primitive, normal_map);
      }
    }
    return meshes_.emplace(index, std::move(primitives)).first->second;
  }

  std::uint32_t material(std::uint32_t index) {
    const auto [entry, is_new] = materials_.try_emplace(index, static_cast<std::uint32_t>(scene_.materials.size()));
    if (is_new) {
      scene_.materials.push_back(index == kNoMaterial ? default_material()
                                                      : read_material(document_, textures_, index));
    }
    return entry->second;
  }

  Document document_;
  TextureReader textures_;
  MotionReader motion_;
  Scene scene_;
  std::map<std::size_t, std::vector<Mesh>> meshes_;
  std::map<std::uint32_t, std::uint32_t> materials_;  // the document's number to the scene's
};

}  // namespace

Scene read_scene(std::span<const std::uint8_t> file, bool must_be_glb, FileReader files, const LoadLimits& limits) {
  return SceneReader(file, must_be_glb, std::move(files), limits).read();
}

}  // namespace luciole::gltf
