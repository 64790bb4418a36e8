// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_lights_cameras.h"

#include <cmath>
#include <optional>
#include <utility>

#include "scene/file_fault.h"

namespace luciole::gltf {
namespace {

constexpr float kPi = 3.14159265f;

Vec3 direction_of(Vec3 v, Vec3 fallback) {
  const float size = length(v);
  return size > 0 && std::isfinite(size) ? v / size : fallback;
}

void check_place(const Affine& world_from_node, const std::string& object) {
  const Vec3 t = world_from_node.translation;
  if (!std::isfinite(length(t))) fail("VALUE_NOT_IN_RANGE", object, "its place is not finite");
}

PunctualLight::Kind light_kind(const JsonObject& light) {
  const std::string type = light.text("type");
  if (type == "point") return PunctualLight::Kind::point;
  if (type == "spot") return PunctualLight::Kind::spot;
  if (type == "directional") return PunctualLight::Kind::directional;
  fail(type.empty() ? "UNDEFINED_PROPERTY" : "VALUE_NOT_IN_LIST", light.label(),
       "its type is not point, spot or directional");
}

void read_cone(const JsonObject& light, PunctualLight& result) {
  const std::optional<JsonObject> spot = light.object("spot");
  if (!spot) fail("UNDEFINED_PROPERTY", light.label(), "property \"spot\" is missing");
  const float inner = spot->number("innerConeAngle", 0), outer = spot->number("outerConeAngle", kPi / 4);
  if (inner < 0 || outer > kPi / 2 + 1e-6f || inner >= outer) {
    fail("KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES", spot->label(), "needs 0 <= innerConeAngle < outerConeAngle <= pi/2");
  }
  result.cos_inner = std::cos(inner);
  result.cos_outer = std::cos(outer);
}

const Json* light_array(const Document& document) {
  const std::optional<JsonObject> extension = document.root().extension("KHR_lights_punctual");
  return extension ? extension->array("lights") : nullptr;
}

}  // namespace

void place_light(PunctualLight& light, const Affine& world_from_node, const std::string& object) {
  check_place(world_from_node, object);
  light.position = world_from_node.translation;
  light.direction =
      direction_of(-world_from_node.z, {0, 0, -1});  // lights and cameras look along -Z; scale does not count
}

void place_camera(Camera& camera, const Affine& world_from_node, const std::string& object) {
  check_place(world_from_node, object);
  camera.eye = world_from_node.translation;
  camera.forward = direction_of(-world_from_node.z, {0, 0, -1});
  // Orthonormal whatever scale or shear the nodes have.
  const Vec3 up = world_from_node.y - camera.forward * dot(world_from_node.y, camera.forward);
  camera.up = direction_of(up, look_at({0, 0, 0}, camera.forward, 1).up);
  camera.right = cross(camera.forward, camera.up);
}

std::size_t light_count(const Document& document) {
  const Json* lights = light_array(document);
  return lights == nullptr ? 0 : lights->size();
}

PunctualLight read_light(Document& document, std::size_t index) {
  const JsonObject light((*light_array(document))[index], "light " + std::to_string(index));
  PunctualLight result;
  result.kind = light_kind(light);
  result.name = light.text("name");
  const auto colour = light.numbers<3>("color", {1, 1, 1});
  const float intensity = light.number("intensity", 1);
  if (intensity < 0 || colour[0] < 0 || colour[1] < 0 || colour[2] < 0) {
    fail("VALUE_NOT_IN_RANGE", light.label(), "has a negative colour or intensity");
  }
  result.intensity = Vec3(colour[0], colour[1], colour[2]) * intensity;
  if (!std::isfinite(length(result.intensity))) fail("VALUE_NOT_IN_RANGE", light.label(), "is too bright for a number");
  if (result.kind == PunctualLight::Kind::spot) read_cone(light, result);
  if (light.has("range")) {
    document.warn("light range", "The range of punctual lights is ignored: light falls off with the squared distance.");
  }
  return result;
}

void read_light_of(Document& document, const JsonObject& node, const Affine& world_from_node, Scene& scene) {
  const std::optional<JsonObject> use = node.extension("KHR_lights_punctual");
  if (!use) return;
  const std::size_t index = use->required_reference("light", light_count(document));
  PunctualLight light = read_light(document, index);
  if (light.name.empty()) light.name = node.text("name");
  place_light(light, world_from_node, node.label());
  scene.lights.push_back(std::move(light));
}

std::optional<Camera> read_camera(Document& document, std::size_t index) {
  const JsonObject camera = document.element(kCameras, index);
  const std::string type = camera.text("type");
  if (type == "orthographic") {
    document.warn("orthographic", "Orthographic cameras are ignored.");
    return std::nullopt;
  }
  const std::optional<JsonObject> perspective = camera.object("perspective");
  if (type != "perspective" || !perspective) {
    fail("ONE_OF_MISMATCH", camera.label(), "is neither a perspective nor an orthographic camera");
  }
  if (!perspective->has("yfov")) fail("UNDEFINED_PROPERTY", perspective->label(), "property \"yfov\" is missing");
  Camera result;
  result.name = camera.text("name");
  result.vertical_fov = perspective->number("yfov", 0);
  if (!(result.vertical_fov > 0) || result.vertical_fov >= kPi) {
    fail("VALUE_NOT_IN_RANGE", perspective->label(), "property \"yfov\" is not between 0 and pi");
  }
  return result;
}

void read_camera_of(Document& document, const JsonObject& node, const Affine& world_from_node, Scene& scene) {
  const std::optional<std::size_t> index = node.reference("camera", document.count(kCameras));
  if (!index) return;
  std::optional<Camera> camera = read_camera(document, *index);
  if (!camera) return;
  if (camera->name.empty()) camera->name = node.text("name");
  place_camera(*camera, world_from_node, node.label());
  scene.cameras.push_back(std::move(*camera));
}

}  // namespace luciole::gltf
