// SPDX-License-Identifier: Apache-2.0
// For tests of everything that evaluates surfaces: random triangles, materials and textures with every combination of
// what they may have.
#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>

#include "scene/mip_pyramid.h"
#include "scene/scene.h"

namespace luciole::test {

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : generator_(seed) {}
  // [0,1), from the top bits: the same in every standard library.
  float unit() { return static_cast<float>(generator_() >> 8) * 0x1p-24f; }
  float within(float low, float high) { return low + (high - low) * unit(); }
  std::uint32_t below(std::uint32_t count) { return generator_() % count; }
  bool flip() { return below(2) == 1; }
  Vec3 in_box(float size) { return {within(-size, size), within(-size, size), within(-size, size)}; }
  Vec3 direction() {
    Vec3 v = in_box(1);
    while (!(dot(v, v) > 0.01f && dot(v, v) < 1)) v = in_box(1);
    return normalize(v);
  }

 private:
  std::mt19937 generator_;
};

inline Texture random_texture(Dice& dice, bool smooth) {
  DecodedImage image;
  image.width = 1 + dice.below(40), image.height = 1 + dice.below(40);
  for (std::uint32_t i = 0; i < image.width * image.height * 4; ++i) {
    image.rgba.push_back(static_cast<std::uint8_t>(dice.below(256)));
  }
  Texture texture;
  texture.image = std::make_shared<const MipImage>(build_mip_pyramid(image, dice.flip()));
  texture.wrap_u = static_cast<Wrap>(dice.below(3)), texture.wrap_v = static_cast<Wrap>(dice.below(3));
  texture.magnify_linear = smooth || dice.flip(), texture.minify_linear = smooth || dice.flip();
  texture.mip_filter = smooth ? MipFilter::linear : static_cast<MipFilter>(dice.below(3));
  return texture;
}

inline TextureSlot random_slot(Dice& dice, const Scene& scene) {
  TextureSlot slot;
  slot.texture = static_cast<std::int32_t>(dice.below(static_cast<std::uint32_t>(scene.textures.size()) + 1)) - 1;
  slot.uv_set = dice.below(2);
  if (dice.flip()) return slot;
  slot.a = dice.within(-2, 2), slot.b = dice.within(-1, 1), slot.c = dice.within(-1, 1), slot.d = dice.within(-2, 2);
  slot.offset = {dice.within(-1, 1), dice.within(-1, 1)};
  return slot;
}

inline Material random_material(Dice& dice, const Scene& scene) {
  Material material;
  material.base_colour = {dice.unit(), dice.unit(), dice.unit(), 1};
  material.base_colour_texture = random_slot(dice, scene);
  // Half of the materials read all their maps alike, as most do.
  const bool alike = dice.flip();
  const auto slot = [&] { return alike ? material.base_colour_texture : random_slot(dice, scene); };
  material.metallic_roughness_texture = slot();
  material.normal_texture = slot();
  material.emissive_texture = slot();
  material.metallic = dice.unit(), material.roughness = dice.within(0.3f, 1);
  material.normal_scale = dice.within(0.2f, 1.5f);
  if (dice.flip()) material.emission = {dice.unit(), dice.unit(), dice.unit()};
  material.double_sided = dice.flip();
  material.dielectric_f0 = {dice.unit(), dice.unit(), dice.unit()}, material.dielectric_f90 = dice.unit();
  if (dice.below(4) == 0) material.metallic_override = dice.unit();
  if (dice.below(4) == 0) material.ggx_alpha_override = dice.unit();
  return material;
}

inline constexpr std::uint32_t kRandomTriangles = 8;  // of a mesh

// Triangles about a metre wide around the origin.
inline Mesh random_mesh(Dice& dice, std::uint32_t material) {
  Mesh mesh;
  mesh.material = material;
  const bool normals = dice.flip(), tangents = dice.flip(), colours = dice.flip(), uv0 = dice.below(4) != 0,
             uv1 = dice.flip();
  for (std::uint32_t t = 0; t < kRandomTriangles; ++t) {
    const Vec3 at = dice.in_box(2), edge1 = dice.direction(), edge2 = normalize(cross(edge1, dice.direction()));
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      mesh.positions.push_back(corner == 0 ? at : at + (corner == 1 ? edge1 : edge2));
      // Turned away from the triangle by less than a right angle, so that no rounding decides on which side they are.
      if (normals) mesh.normals.push_back(normalize(cross(edge1, edge2) + dice.in_box(0.4f)));
      const Vec3 tangent = normalize(edge1 + dice.in_box(0.3f));
      if (tangents) mesh.tangents.push_back({tangent.x, tangent.y, tangent.z, dice.flip() ? 1.0f : -1.0f});
      if (colours) mesh.colours.push_back({dice.within(0, 1.2f), dice.unit(), dice.unit(), 1});
      if (uv0) mesh.uv[0].push_back({dice.within(-3, 3), dice.within(-3, 3)});
      if (uv1) mesh.uv[1].push_back({dice.within(-3, 3), dice.within(-3, 3)});
      mesh.indices.push_back(3 * t + corner);
    }
    if (tangents) mesh.tangents[3 * t + 2].w = mesh.tangents[3 * t + 1].w = mesh.tangents[3 * t].w;
  }
  return mesh;
}

inline Scene random_scene(Dice& dice, bool smooth) {
  Scene scene;
  for (int i = 0; i < 6; ++i) scene.textures.push_back(random_texture(dice, smooth));
  for (std::uint32_t i = 0; i < 200; ++i) {
    scene.materials.push_back(random_material(dice, scene));
    scene.meshes.push_back(random_mesh(dice, i));
  }
  return scene;
}

// Triangles without area, and coordinates that are not numbers.
inline Scene broken_scene(Dice& dice) {
  Scene scene = random_scene(dice, true);
  for (Mesh& mesh : scene.meshes) {
    mesh.positions[1] = mesh.positions[2] = mesh.positions[0];
    for (auto& set : mesh.uv) {
      if (set.size() > 5) set[4] = {INFINITY, NAN}, set[5] = {-1e30f, 1e30f};
    }
  }
  return scene;
}

}  // namespace luciole::test
