// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_primitives.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/file_fault.h"
#include "scene/gltf_accessor.h"

namespace luciole::gltf {
namespace {

enum class Mode : std::uint64_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

// An attribute's values and how many numbers each has; components 0: the primitive lacks the attribute.
struct Attribute {
  std::vector<float> values;
  std::uint32_t components = 0;
  std::size_t count() const { return components == 0 ? 0 : values.size() / components; }
};

Attribute read_attribute(Document& document, const JsonObject& attributes, const char* name, std::uint32_t least,
                         std::uint32_t most) {
  const std::optional<std::size_t> accessor = attributes.reference(name, document.count(kAccessors));
  if (!accessor) return {};
  const AccessorShape shape = accessor_shape(document, *accessor);
  if (shape.components < least || shape.components > most || shape.component_type == ComponentType::uint32) {
    fail("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", attributes.label(),
         std::string(name) + " cannot be read from " + shape.label);
  }
  document.charge_vertices(shape.count, shape.label);
  return {read_floats(document, *accessor), shape.components};
}

void check_count(const Attribute& attribute, std::size_t vertices, const JsonObject& attributes, const char* name) {
  if (attribute.components != 0 && attribute.count() != vertices) {
    fail("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", attributes.label(),
         std::string(name) + " has " + std::to_string(attribute.count()) + " elements where POSITION has " +
             std::to_string(vertices));
  }
}

std::vector<Vec3> as_vec3(const Attribute& attribute) {
  std::vector<Vec3> result(attribute.count());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const float* v = &attribute.values[i * 3];
    result[i] = {v[0], v[1], v[2]};
  }
  return result;
}

std::vector<Vec2> as_vec2(const Attribute& attribute) {
  std::vector<Vec2> result(attribute.count());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {attribute.values[i * 2], attribute.values[i * 2 + 1]};
  return result;
}

std::vector<Vec4> as_vec4(const Attribute& attribute) {  // three components get w = 1
  std::vector<Vec4> result(attribute.count());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const float* v = &attribute.values[i * attribute.components];
    result[i] = {v[0], v[1], v[2], attribute.components == 4 ? v[3] : 1.0f};
  }
  return result;
}

void read_vertices(Document& document, const JsonObject& attributes, Mesh& mesh) {
  const Attribute positions = read_attribute(document, attributes, "POSITION", 3, 3);
  mesh.positions = as_vec3(positions);
  const std::size_t vertices = mesh.positions.size();
  const auto optional_attribute = [&](const char* name, std::uint32_t least, std::uint32_t most) {
    Attribute attribute = read_attribute(document, attributes, name, least, most);
    check_count(attribute, vertices, attributes, name);
    return attribute;
  };
  mesh.normals = as_vec3(optional_attribute("NORMAL", 3, 3));
  // Tangents belong to normals: without these the format tells us to ignore them.
  if (!mesh.normals.empty()) mesh.tangents = as_vec4(optional_attribute("TANGENT", 4, 4));
  mesh.uv[0] = as_vec2(optional_attribute("TEXCOORD_0", 2, 2));
  mesh.uv[1] = as_vec2(optional_attribute("TEXCOORD_1", 2, 2));
  mesh.colours = as_vec4(optional_attribute("COLOR_0", 3, 4));
}

std::vector<std::uint32_t> read_corners(Document& document, const JsonObject& primitive, std::size_t vertices) {
  const std::optional<std::size_t> accessor = primitive.reference("indices", document.count(kAccessors));
  std::vector<std::uint32_t> corners;
  if (!accessor) {
    document.charge_vertices(vertices, primitive.label());
    corners.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
    return corners;
  }
  const AccessorShape shape = accessor_shape(document, *accessor);
  document.charge_vertices(shape.count, shape.label);
  corners = read_indices(document, *accessor);
  for (const std::uint32_t corner : corners) {
    if (corner >= vertices) {
      fail("ACCESSOR_INDEX_OOB", primitive.label(),
           "index " + std::to_string(corner) + " of " + shape.label + " is beyond the " + std::to_string(vertices) +
               " vertices");
    }
  }
  return corners;
}

// glTF 2.0, 3.7.2.1: the vertices of triangle i, chosen so that all wind alike.
std::vector<std::uint32_t> as_triangle_list(std::vector<std::uint32_t> corners, Mode mode) {
  if (mode == Mode::triangles) {
    corners.resize(corners.size() / 3 * 3);
    return corners;
  }
  std::vector<std::uint32_t> list;
  if (corners.size() < 3) return list;
  list.reserve((corners.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == Mode::triangle_strip) {
      list.insert(list.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    } else {
      list.insert(list.end(), {corners[i + 1], corners[i + 2], corners[0]});
    }
  }
  return list;
}

// Every attribute has to refer to an accessor, whether it is read or not.
void check_attributes(const Document& document, const JsonObject& attributes) {
  for (const auto& [name, value] : attributes.json().items()) {
    attributes.required_reference(name.c_str(), document.count(kAccessors));
  }
}

bool has_morph_targets(const Document& document, const JsonObject& primitive) {
  const std::vector<JsonObject> targets = primitive.objects("targets", "target");
  for (const JsonObject& target : targets) check_attributes(document, target);
  return !targets.empty();
}

std::optional<Mesh> read_primitive(Document& document, const JsonObject& primitive) {
  const std::uint64_t mode = primitive.whole("mode", static_cast<std::uint64_t>(Mode::triangles));
  if (mode > static_cast<std::uint64_t>(Mode::triangle_fan)) {
    fail("VALUE_NOT_IN_LIST", primitive.label(), "has the unknown mode " + std::to_string(mode));
  }
  const std::optional<JsonObject> attributes = primitive.object("attributes");
  if (!attributes) fail("UNDEFINED_PROPERTY", primitive.label(), "property \"attributes\" is missing");
  check_attributes(document, *attributes);
  if (has_morph_targets(document, primitive)) {
    document.warn("morph targets", "Morph targets are ignored: meshes keep their base shape.");
  }
  if (mode < static_cast<std::uint64_t>(Mode::triangles)) {
    document.warn("points and lines", "Points and lines are ignored.");
    return std::nullopt;
  }
  if (!attributes->has("POSITION")) {
    document.warn("no positions", "Primitives without positions are ignored: " + primitive.label() + ".");
    return std::nullopt;
  }
  Mesh mesh;
  read_vertices(document, *attributes, mesh);
  std::vector<std::uint32_t> corners = read_corners(document, primitive, mesh.positions.size());
  mesh.indices = as_triangle_list(std::move(corners), static_cast<Mode>(mode));
  const std::optional<std::size_t> material = primitive.reference("material", document.count(kMaterials));
  mesh.material = material ? static_cast<std::uint32_t>(*material) : kNoMaterial;
  if (mesh.indices.empty()) return std::nullopt;
  return mesh;
}

}  // namespace

std::vector<Mesh> read_mesh(Document& document, std::size_t index) {
  const JsonObject object = document.element(kMeshes, index);
  const Json* primitives = object.array("primitives");
  if (primitives == nullptr) fail("UNDEFINED_PROPERTY", object.label(), "property \"primitives\" is missing");
  if (primitives->empty()) fail("EMPTY_ENTITY", object.label(), "has no primitives");
  std::vector<Mesh> meshes;
  for (const JsonObject& primitive : object.objects("primitives", "primitive")) {
    std::optional<Mesh> mesh = read_primitive(document, primitive);
    if (!mesh) continue;
    mesh->name = object.text("name");
    meshes.push_back(std::move(*mesh));
  }
  return meshes;
}

}  // namespace luciole::gltf
