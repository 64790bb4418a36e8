// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/recipes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "scene/recipes/mesh_builder.h"

namespace luciole {
namespace {

using Parameters = std::map<std::string, std::string>;

struct Sample {
  const char* name;
  Parameters parameters;
};

const std::vector<Sample>& small_samples() {
  static const std::vector<Sample> samples = {{"gallery", {{"detail", "0.05"}}},
                                              {"ring", {}},
                                              {"cornell", {{"glossy", "0.1"}, {"panel", "5"}}},
                                              {"lights", {{"count", "333"}}},
                                              {"lamps", {{"count", "1001"}, {"textured", "1"}}},
                                              {"lamps", {{"count", "80"}, {"glossy", "0.2"}}}};
  return samples;
}

Scene make(const std::string& name, const Parameters& parameters) {
  Result<Scene> scene = make_recipe(name, parameters);
  EXPECT_TRUE(scene.has_value()) << name;
  return scene.has_value() ? std::move(*scene) : Scene{};
}

class Hash {
 public:
  template <class T, class Allocator>
  void add(const std::vector<T, Allocator>& values) {
    add(values.data(), values.size() * sizeof(T));
  }
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) state_ = (state_ ^ bytes[i]) * 1099511628211ull;
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 14695981039346656037ull;
};

std::uint64_t hash_of(const Scene& scene) {
  Hash hash;
  for (const Mesh& mesh : scene.meshes) {
    hash.add(mesh.positions), hash.add(mesh.normals), hash.add(mesh.tangents), hash.add(mesh.uv[0]);
    hash.add(mesh.indices), hash.add(&mesh.material, sizeof mesh.material);
  }
  for (const Material& material : scene.materials) {
    hash.add(&material.base_colour, sizeof material.base_colour), hash.add(&material.roughness, sizeof(float));
  }
  for (const Texture& texture : scene.textures) hash.add(texture.image->rgba);
  for (const PunctualLight& light : scene.lights) {
    hash.add(&light.position, sizeof light.position), hash.add(&light.intensity, sizeof light.intensity);
  }
  return hash.value();
}

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// What is wrong with a mesh, in words; empty: nothing.
std::string fault_of(const Mesh& mesh, std::size_t materials) {
  const std::size_t count = mesh.positions.size();
  if (mesh.material >= materials) return "material out of range";
  if (mesh.normals.size() != count) return "normals differ in number";
  if (!mesh.uv[0].empty() && mesh.uv[0].size() != count) return "texture coordinates differ in number";
  if (!mesh.tangents.empty() && mesh.tangents.size() != count) return "tangents differ in number";
  for (std::size_t i = 0; i < count; ++i) {
    if (!finite(mesh.positions[i])) return "position " + std::to_string(i) + " is not finite";
    if (!(std::abs(length(mesh.normals[i]) - 1) < 1e-4f))
      return "normal " + std::to_string(i) + " is not a unit vector";
  }
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    const Vec4 t = mesh.tangents[i];
    if (!(std::abs(length(Vec3{t.x, t.y, t.z}) - 1) < 1e-4f) || std::abs(t.w) != 1)
      return "a tangent is not a unit vector";
  }
  if (mesh.indices.empty() || mesh.indices.size() % 3 != 0) return "indices do not make triangles";
  for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
    const std::uint32_t a = mesh.indices[k], b = mesh.indices[k + 1], c = mesh.indices[k + 2];
    if (std::max({a, b, c}) >= count) return "index out of range";
    if (a == b || b == c || c == a) return "triangle " + std::to_string(k / 3) + " has an index twice";
  }
  return "";
}

// How many edges belong to one triangle only, where places that are the same bit for bit are one corner.
std::size_t open_edges(const Mesh& mesh) {
  using Place = std::tuple<float, float, float>;
  std::map<Place, std::uint32_t> corner_at;
  std::vector<std::uint32_t> corner;
  for (const Vec3 p : mesh.positions) {
    corner.push_back(
        corner_at.emplace(Place{p.x, p.y, p.z}, static_cast<std::uint32_t>(corner_at.size())).first->second);
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = corner[mesh.indices[k + e]], b = corner[mesh.indices[k + (e + 1) % 3]];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return static_cast<std::size_t>(
      std::count_if(balance.begin(), balance.end(), [](const auto& e) { return e.second != 0; }));
}

bool is_metal(const Material& material) { return material.metallic == 1; }

TEST(Recipes, make_the_same_scene_every_time) {
  for (const auto& [name, parameters] : small_samples()) {
    EXPECT_EQ(hash_of(make(name, parameters)), hash_of(make(name, parameters))) << name;
  }
}

TEST(Recipes, another_seed_or_parameter_makes_another_scene) {
  EXPECT_NE(hash_of(make("lights", {{"seed", "1"}})), hash_of(make("lights", {{"seed", "2"}})));
  EXPECT_NE(hash_of(make("lamps", {{"count", "99"}})), hash_of(make("lamps", {{"count", "99"}, {"seed", "7"}})));
  EXPECT_NE(hash_of(make("ring", {{"alpha", "0.1"}})), hash_of(make("ring", {{"alpha", "0.2"}})));
}

TEST(Recipes, make_finite_meshes_with_unit_normals_and_whole_triangles) {
  for (const auto& [name, parameters] : small_samples()) {
    const Scene scene = make(name, parameters);
    for (const Mesh& mesh : scene.meshes)
      EXPECT_EQ(fault_of(mesh, scene.materials.size()), "") << name << ": " << mesh.name;
    EXPECT_FALSE(scene.cameras.empty()) << name;
    EXPECT_FALSE(scene.textures.empty() && std::string(name) == "gallery");
  }
}

TEST(Recipes, the_check_of_meshes_finds_planted_faults) {
  const Scene ring = make("ring", {});
  const auto fault_after = [&](auto&& harm) {
    Mesh mesh = ring.meshes[1];
    harm(mesh);
    return fault_of(mesh, ring.materials.size());
  };
  EXPECT_NE(fault_after([](Mesh& m) { m.positions[5].y = NAN; }), "");
  EXPECT_NE(fault_after([](Mesh& m) { m.normals[5] = m.normals[5] * 1.01f; }), "");
  EXPECT_NE(fault_after([](Mesh& m) { m.indices[4] = m.indices[3]; }), "");
  EXPECT_NE(fault_after([](Mesh& m) { m.indices[4] = 1u << 30; }), "");
  EXPECT_NE(fault_after([](Mesh& m) { m.material = 77; }), "");
}

TEST(Recipes, ring_has_about_as_many_triangles_as_the_paper_and_its_alpha) {
  const Scene scene = make("ring", {{"alpha", "0.05"}});
  EXPECT_EQ(scene.triangle_count(), 8192u);
  EXPECT_NEAR(std::pow(scene.materials.at(scene.meshes.at(1).material).roughness, 2), 0.05, 1e-6);
  EXPECT_EQ(open_edges(scene.meshes.at(1)), 0u);
  EXPECT_GT(open_edges(scene.meshes.at(0)), 0u);  // the plane has a rim: the test can fail
}

TEST(Recipes, lights_and_lamps_are_counted_exactly) {
  for (const char* count : {"1", "2", "17", "1000"}) {
    EXPECT_EQ(make("lights", {{"count", count}}).lights.size(), std::stoul(count));
    const Scene scene = make("lamps", {{"count", count}});
    std::uint64_t emissive = 0;
    for (const Mesh& mesh : scene.meshes) {
      if (scene.materials[mesh.material].emission.x > 0) emissive += mesh.indices.size() / 3;
    }
    EXPECT_EQ(emissive, std::stoull(count));
  }
}

TEST(Recipes, lamps_give_the_same_flux_however_many_there_are) {
  const auto flux = [](const char* count) {
    const Scene scene = make("lamps", {{"count", count}});
    double sum = 0;
    for (const Mesh& mesh : scene.meshes) {
      const Vec3 radiance = scene.materials[mesh.material].emission;
      for (std::size_t k = 0; radiance.x > 0 && k < mesh.indices.size(); k += 3) {
        const Vec3 a = mesh.positions[mesh.indices[k]];
        const Vec3 twice_area = cross(mesh.positions[mesh.indices[k + 1]] - a, mesh.positions[mesh.indices[k + 2]] - a);
        sum += 3.14159265 * 0.5 * length(twice_area) * (radiance.x + radiance.y + radiance.z) / 3;
      }
    }
    return sum;
  };
  // Colours are drawn by chance: a few lamps may be a little stronger or weaker than the mean.
  EXPECT_NEAR(flux("20000") / flux("4000"), 1, 0.03);
}

TEST(Recipes, gallery_shows_many_metals_and_none_twice_with_the_same_alpha) {
  const Scene scene = make("gallery", {{"detail", "0.05"}});
  std::set<std::string> kinds;
  std::set<float> alphas;
  std::size_t metal_meshes = 0;
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = scene.materials[mesh.material];
    if (!is_metal(material)) continue;
    ++metal_meshes;
    kinds.insert(mesh.name);
    alphas.insert(material.roughness);
    EXPECT_GE(material.roughness * material.roughness, 0.049f) << mesh.name;
    EXPECT_LE(material.roughness * material.roughness, 0.5f) << mesh.name;
  }
  EXPECT_GE(kinds.size(), 12u);
  EXPECT_EQ(alphas.size(), metal_meshes);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].kind, PunctualLight::Kind::directional);
}

TEST(Recipes, gallery_is_full_at_full_detail_and_small_at_little) {
  const std::uint64_t full = make("gallery", {}).triangle_count();
  EXPECT_GE(full, 1300000u);
  EXPECT_LE(full, 1500000u);
  EXPECT_LE(make("gallery", {{"detail", "0.05"}}).triangle_count(),
            full / 5);  // plates and mouldings are coarse already
}

TEST(Recipes, turned_and_cut_objects_are_closed) {
  // Sweeps end in caps whose rims are the sweep's, bit for bit; mouldings and cloths are open and not claimed.
  const std::set<std::string> closed = {"wedding ring", "bowl",    "tall goblet", "coil spring",  "torus knot",
                                        "mirror dish",  "letters", "large gear",  "chess bishop", "candlestick"};
  std::size_t seen = 0;
  for (const Mesh& mesh : make("gallery", {{"detail", "0.05"}}).meshes) {
    if (!closed.contains(mesh.name)) continue;
    EXPECT_EQ(open_edges(mesh), 0u) << mesh.name;
    ++seen;
  }
  EXPECT_EQ(seen, closed.size());
}

TEST(Recipes, bad_names_and_values_are_refused_in_a_sentence_that_helps) {
  const auto refusal = [](const std::string& name, const Parameters& parameters) {
    const Result<Scene> scene = make_recipe(name, parameters);
    EXPECT_FALSE(scene.has_value()) << name;
    if (scene.has_value()) return std::string();
    EXPECT_EQ(scene.error().kind, ErrorKind::usage);
    return scene.error().message;
  };
  EXPECT_NE(refusal("rign", {}).find("gallery, ring, cornell, lights, lamps"), std::string::npos);
  EXPECT_NE(refusal("ring", {{"alpah", "1"}}).find("alpha"), std::string::npos);
  for (const char* value : {"", "x", "0.1x", "nan", "inf", "-1", "2", "1e999", " 0.5"}) {
    EXPECT_NE(refusal("ring", {{"alpha", value}}).find("from 0.001 to 1"), std::string::npos) << value;
  }
  refusal("lights", {{"count", "2.5"}});
  refusal("lights", {{"count", "99999999999"}});
  EXPECT_TRUE(make_recipe("ring", {{"alpha", "0.5"}}).has_value());
}

TEST(Recipes, are_found_by_their_address) {
  const Result<Scene> scene = make_recipe_from_address("recipe:ring?alpha=0.2&detail=0.5");
  ASSERT_TRUE(scene.has_value());
  EXPECT_EQ(hash_of(*scene), hash_of(make("ring", {{"alpha", "0.2"}, {"detail", "0.5"}})));
  EXPECT_TRUE(make_recipe_from_address("recipe:ring").has_value());
  for (const char* address :
       {"ring", "recipe:", "recipe:ring?alpha", "recipe:ring?=1", "recipe:ring?alpha=1&alpha=1"}) {
    EXPECT_FALSE(make_recipe_from_address(address).has_value()) << address;
  }
}

TEST(Recipes, every_recipe_describes_itself) {
  for (const RecipeDescription& recipe : recipes()) {
    EXPECT_FALSE(recipe.summary.empty());
    for (const RecipeParameter& p : recipe.parameters) {
      EXPECT_FALSE(p.meaning.empty());
      EXPECT_LE(p.low, p.default_value);
      EXPECT_GE(p.high, p.default_value);
    }
  }
}

}  // namespace
}  // namespace luciole
