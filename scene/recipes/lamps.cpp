// SPDX-License-Identifier: Apache-2.0
// A hall hung with festoons of lamps: exactly `count` emissive triangles, all together of one flux however many there
// are. A lamp is an octahedron of eight facets; the last one has what is left.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/recipes/colonnade.h"
#include "scene/recipes/hash.h"
#include "scene/recipes/recipe_list.h"
#include "scene/recipes/scene_kit.h"
#include "scene/recipes/texture_painter.h"

namespace luciole::workshop {
namespace {

constexpr float kTotalFlux = 2400;     // of all lamps [W]
constexpr std::uint32_t kColours = 6;  // kinds of lamp
constexpr std::uint32_t kFacets = 8;

// Where lamp `index` of `count` hangs: festoons from wall to wall, between the columns' capitals, sagging in the
// middle.
Vec3 hanging_point(std::uint32_t index, std::uint32_t count, std::uint32_t seed, const HallSize& size) {
  const auto strings = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::sqrt(static_cast<float>(count)) / 2));
  const float along = (static_cast<float>(index / strings) + 0.5f) / static_cast<float>((count - 1) / strings + 1);
  const float across = (static_cast<float>(index % strings) + 0.5f) / static_cast<float>(strings);
  const float sag = 4 * along * (1 - along);
  const float jitter = 0.12f * (unit_hash(seed, index, 0) - 0.5f);
  const float depth = 0.7f + 0.5f * std::sin(7 * across);  // neighbouring strings hang differently
  return {(size.width - 0.6f) * (along - 0.5f), size.height - 0.35f - depth * sag + jitter,
          (size.length - 0.6f) * (across - 0.5f) + jitter};
}

// The first `facets` faces of an octahedron, flat-shaded.
Mesh lamp(float radius, std::uint32_t facets) {
  Mesh mesh;
  for (std::uint32_t facet = 0; facet < facets; ++facet) {
    const Vec3 x{facet & 1u ? -radius : radius, 0, 0}, y{0, facet & 2u ? -radius : radius, 0},
        z{0, 0, facet & 4u ? -radius : radius};
    const Vec3 outwards = normalize(x + y + z);
    const bool mirrored = dot(cross(y - x, z - x), outwards) < 0;
    const std::array<Vec3, 3> corners = mirrored ? std::array{x, z, y} : std::array{x, y, z};
    for (std::uint32_t k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(corners[k]);
      mesh.normals.push_back(outwards);
      mesh.uv[0].push_back({k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f});
    }
  }
  return mesh;
}

// Stripes of full and quarter light; glTF's emissive textures are sRGB.
Texture striped_shade() {
  return paint("striped shade", 4, Encoding::srgb, [](Vec2 place) {
    const float light = static_cast<int>(4 * place.x) % 2 == 0 ? 1.0f : 0.25f;
    return Vec3{light, light, light};
  });
}

// Lamps of one colour each, mean one.
Vec3 lamp_colour(std::uint32_t kind) {
  const float hue = static_cast<float>(kind) / kColours;
  return {1.1f + 0.5f * std::cos(kTwoPi * hue), 1 + 0.4f * std::cos(kTwoPi * (hue - 0.3f)),
          0.9f + 0.6f * std::cos(kTwoPi * (hue - 0.6f))};
}

void add_lamp_materials(Scene& scene, float radiance, bool textured) {
  if (textured) scene.textures.push_back(striped_shade());
  for (std::uint32_t kind = 0; kind < kColours; ++kind) {
    Material glow = matte_material("lamp " + std::to_string(kind), {0.5f, 0.5f, 0.5f});
    glow.emission = lamp_colour(kind) * radiance;
    if (textured) glow.emissive_texture.texture = 0;
    add_material(scene, glow);
  }
}

Scene make_lamps(const Values& values) {
  const HallSize size;
  const auto triangles = static_cast<std::uint32_t>(values.at("count"));
  const auto seed = static_cast<std::uint32_t>(values.at("seed"));
  const std::uint32_t lamps = (triangles + kFacets - 1) / kFacets;
  // Lamps share the space: their surfaces together stay below two square metres, and no lamp is larger than 9 cm.
  const float radius = std::min(0.09f, 0.45f / std::sqrt(static_cast<float>(lamps)));
  const float facet_area = 0.8660254f * radius * radius;  // an equilateral triangle of side sqrt(2) radius
  Scene scene;
  add_colonnade(scene, size);
  if (const auto alpha = static_cast<float>(values.at("glossy")); alpha > 0) {
    for (Material& material : scene.materials) {
      const Vec4 colour = material.base_colour;
      material = metal_material(material.name, {colour.x, colour.y, colour.z}, alpha);
    }
  }
  const auto first_lamp = static_cast<std::uint32_t>(scene.materials.size());
  add_lamp_materials(scene, kTotalFlux / (kPi * facet_area * static_cast<float>(triangles)),
                     values.at("textured") == 1);
  std::array<Mesh, kColours> by_kind;
  const Mesh whole = lamp(radius, kFacets), last = lamp(radius, triangles - (lamps - 1) * kFacets);
  for (std::uint32_t i = 0; i < lamps; ++i) {
    append(by_kind[hash(seed, i, 1) % kColours], i + 1 == lamps ? last : whole,
           translate(hanging_point(i, lamps, seed, size)));
  }
  for (std::uint32_t kind = 0; kind < kColours; ++kind) {
    if (by_kind[kind].indices.empty()) continue;
    add_mesh(scene, "lamps " + std::to_string(kind), first_lamp + kind, std::move(by_kind[kind]));
  }
  if (values.at("matte") == 1) {
    for (Material& material : scene.materials) material = made_matte(material);
  }
  scene.cameras.push_back(named_camera("hall", {{1.1f, 1.6f, 8.4f}, {-0.3f, 1.75f, 0}}, 56));
  return scene;
}

}  // namespace

Recipe lamps_recipe() {
  return {{"lamps",
           "a hall of columns hung with lamps: many emissive triangles",
           {{"count", "number of emissive triangles", 100000, 1, 1048576, true},
            {"textured", "1: the lamps have striped shades (an emissive texture)", 0, 0, 1, true},
            {"glossy", "GGX alpha of all surfaces, which then are metals; 0: floor, ball and jar shine", 0, 0, 1},
            {"matte", "1: no surface reflects, also floor, ball and jar scatter evenly, as pbrt can show it", 0, 0, 1,
             true},
            {"seed", "another seed, another arrangement", 1, 0, 4294967295.0, true}}},
          make_lamps};
}

}  // namespace luciole::workshop
