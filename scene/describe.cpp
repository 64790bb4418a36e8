// SPDX-License-Identifier: Apache-2.0
#include "scene/describe.h"

#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "scene/default_lights.h"
#include "scene/emissive_triangles.h"

namespace luciole {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

std::string vector(Vec3 v) { return "(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")"; }

std::string line(const std::string& name, const std::string& value) {
  return name + std::string(name.size() < 20 ? 20 - name.size() : 1, ' ') + value + "\n";
}

std::string textures_in_words(const Scene& scene) {
  std::set<const MipImage*> images;
  double megabytes = 0;
  for (const Texture& texture : scene.textures) {
    if (!images.insert(texture.image.get()).second) continue;
    megabytes += static_cast<double>(texture.image->rgba.size()) / 1e6;
  }
  return std::to_string(scene.textures.size()) + " of " + std::to_string(images.size()) + " images, " +
         number(megabytes) + " MB with mip levels";
}

std::string lights_in_words(const Scene& scene, float radius) {
  std::string text;
  for (const PunctualLight& light : scene.lights) {
    const char* kind = light.kind == PunctualLight::Kind::point  ? "point"
                       : light.kind == PunctualLight::Kind::spot ? "spot"
                                                                 : "directional";
    const bool placed = light.kind != PunctualLight::Kind::directional;
    text += line("  " + std::string(kind), "\"" + light.name + "\", " + number(power(light, radius)) + " W" +
                                               (placed ? " at " + vector(light.position) : "") +
                                               (kind[0] == 'p' ? "" : " towards " + vector(light.direction)));
  }
  return text;
}

std::string emission_in_words(const Scene& scene) {
  const std::vector<EmissiveTriangle> triangles = emissive_triangles(scene);
  double flux = 0, area = 0;
  for (const EmissiveTriangle& triangle : triangles) {
    const Vec3 w = power(triangle);
    flux += (static_cast<double>(w.x) + w.y + w.z) / 3;
    area += triangle.area;
  }
  std::string text = std::to_string(triangles.size());
  if (!triangles.empty()) text += ", " + number(flux) + " W from " + number(area) + " m^2";
  return text;
}

}  // namespace

std::string describe(const Scene& scene) {
  const Bounds bounds = scene.bounds();
  const bool empty = scene.triangle_count() == 0;
  std::string text = line("scene", scene.name);
  text += line("triangles",
               std::to_string(scene.triangle_count()) + " in " + std::to_string(scene.meshes.size()) + " meshes");
  text += line("bounds [m]", empty ? "none" : vector(bounds.low) + " to " + vector(bounds.high));
  text += line("materials", std::to_string(scene.materials.size()));
  text += line("textures", textures_in_words(scene));
  text += line("emissive triangles", emission_in_words(scene));
  text += line("punctual lights", std::to_string(scene.lights.size()));
  text += lights_in_words(scene, empty ? 0.0f : 0.5f * bounds.diagonal());
  text += line("cameras", std::to_string(scene.cameras.size()));
  for (const Camera& camera : scene.cameras) {
    text += line("  \"" + camera.name + "\"", "at " + vector(camera.eye) + " towards " + vector(camera.forward) + ", " +
                                                  number(camera.vertical_fov * 57.29578) + " degrees high");
  }
  for (const std::string& warning : scene.warnings) text += line("warning", warning);
  return text;
}

}  // namespace luciole
