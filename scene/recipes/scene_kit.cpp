// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/scene_kit.h"

#include <cmath>

#include "scene/mesh_finish.h"

namespace luciole::workshop {

std::uint32_t add_material(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Material metal_material(std::string name, Vec3 f0, float ggx_alpha) {
  Material material;
  material.name = std::move(name);
  material.base_colour = {f0.x, f0.y, f0.z, 1};
  material.metallic = 1;
  material.roughness = std::sqrt(ggx_alpha);
  return material;
}

Material dielectric_material(std::string name, Vec3 albedo, float ggx_alpha) {
  Material material = metal_material(std::move(name), albedo, ggx_alpha);
  material.metallic = 0;
  return material;
}

Material matte_material(std::string name, Vec3 albedo) {
  Material material = dielectric_material(std::move(name), albedo, 1);
  material.dielectric_f0 = {0, 0, 0};
  material.dielectric_f90 = 0;
  return material;
}

Material made_matte(Material material) {
  material.metallic = 0, material.roughness = 1;
  material.metallic_roughness_texture = {};
  material.dielectric_f0 = {0, 0, 0};
  material.dielectric_f90 = 0;
  return material;
}

void add_mesh(Scene& scene, std::string name, std::uint32_t material, Mesh mesh) {
  mesh.name = std::move(name);
  mesh.material = material;
  const Material& look = scene.materials[material];
  const bool textured = look.base_colour_texture.texture >= 0 || look.metallic_roughness_texture.texture >= 0 ||
                        look.normal_texture.texture >= 0 || look.emissive_texture.texture >= 0;
  if (!textured) mesh.uv[0].clear();
  drop_unused_vertices(mesh);
  scene.meshes.push_back(std::move(mesh));
}

PunctualLight spot_light(std::string name, Aim aim, Vec3 intensity, float inner_degrees, float outer_degrees) {
  PunctualLight light = point_light(std::move(name), aim.from, intensity);
  light.kind = PunctualLight::Kind::spot;
  light.direction = normalize(aim.at - aim.from);
  light.cos_inner = std::cos(radians(inner_degrees));
  light.cos_outer = std::cos(radians(outer_degrees));
  return light;
}

PunctualLight point_light(std::string name, Vec3 position, Vec3 intensity) {
  PunctualLight light;
  light.name = std::move(name);
  light.position = position;
  light.intensity = intensity;
  return light;
}

PunctualLight sun_light(std::string name, Vec3 towards, Vec3 irradiance) {
  PunctualLight light = point_light(std::move(name), {0, 0, 0}, irradiance);
  light.kind = PunctualLight::Kind::directional;
  light.direction = normalize(towards);
  return light;
}

Camera named_camera(std::string name, Aim aim, float vertical_fov_degrees) {
  Camera camera = look_at(aim.from, aim.at, radians(vertical_fov_degrees));
  camera.name = std::move(name);
  return camera;
}

}  // namespace luciole::workshop
