// SPDX-License-Identifier: Apache-2.0
// Short words for putting a scene together.
#pragma once
#include "scene/recipes/mesh_builder.h"
#include "scene/recipes/placement.h"

namespace luciole::workshop {

std::uint32_t add_material(Scene& scene, Material material);

// A metal of normal-incidence reflectance f0. `ggx_alpha` is the papers' roughness; glTF stores its square root.
Material metal_material(std::string name, Vec3 f0, float ggx_alpha);

// A dielectric of index 1.5 under which light scatters.
Material dielectric_material(std::string name, Vec3 albedo, float ggx_alpha);

// Scatters light evenly and reflects none (KHR_materials_specular factor 0).
Material matte_material(std::string name, Vec3 albedo);
// The same colour, textures and emission on a surface that scatters evenly and reflects none.
Material made_matte(Material material);

// Leaves out what is not used: lone vertices, and texture coordinates where the material has no texture.
void add_mesh(Scene& scene, std::string name, std::uint32_t material, Mesh mesh);

struct Aim {
  Vec3 from, at;  // [m]
};
PunctualLight spot_light(std::string name, Aim aim, Vec3 intensity, float inner_degrees, float outer_degrees);
PunctualLight point_light(std::string name, Vec3 position, Vec3 intensity);
// towards: the way the light travels. irradiance [W/m^2] on a surface that faces it.
PunctualLight sun_light(std::string name, Vec3 towards, Vec3 irradiance);

Camera named_camera(std::string name, Aim aim, float vertical_fov_degrees);

}  // namespace luciole::workshop
