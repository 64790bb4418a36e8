// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/animation.h"
#include "scene/load_scene.h"
#include "scene/mip_pyramid.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

fs::path scratch(const std::string& name) {
  const fs::path folder = fs::path(LUCIOLE_SCRATCH_DIR) / "written_gltf";
  fs::create_directories(folder);
  return folder / name;
}

// Every feature that the writer knows, once.
Scene rich_scene() {
  Scene scene = *make_recipe("cornell", {{"glossy", "0.2"}, {"panel", "5"}});
  DecodedImage pixels{4, 2, {}};
  for (std::uint8_t i = 0; i < 32; ++i) pixels.rgba.push_back(static_cast<std::uint8_t>(8 * i));
  Texture texture;
  texture.name = "colours";
  texture.image = std::make_shared<const MipImage>(build_mip_pyramid(pixels, true));
  texture.wrap_u = Wrap::mirrored_repeat, texture.wrap_v = Wrap::clamp_to_edge;
  texture.magnify_linear = false, texture.mip_filter = MipFilter::nearest;
  scene.textures.push_back(texture);
  Texture bumps = texture;
  bumps.name = "bumps";
  bumps.image = std::make_shared<const MipImage>(build_mip_pyramid(pixels, false));
  scene.textures.push_back(bumps);
  Material& material = scene.materials[0];
  material.base_colour = {0.5f, 0.25f, 0.125f, 0.75f};
  material.base_colour_texture.texture = 0;
  const float turn = 0.5f;
  material.base_colour_texture.a = 2 * std::cos(turn), material.base_colour_texture.b = -3 * std::sin(turn);
  material.base_colour_texture.c = -2 * std::sin(turn), material.base_colour_texture.d = -3 * std::cos(turn);
  material.base_colour_texture.offset = {0.25f, 0.5f};
  material.normal_texture.texture = 1, material.normal_scale = 0.5f;
  material.alpha_mode = AlphaMode::mask, material.alpha_cutoff = 0.25f;
  material.double_sided = true;
  material.dielectric_f0 = {0.02f, 0.03f, 0.04f}, material.dielectric_f90 = 0.75f;
  scene.materials[1].dielectric_f0 = {0.08f, 0.08f, 0.08f}, scene.materials[1].dielectric_f90 = 1;
  scene.materials[2].name = scene.materials[1].name;
  for (Mesh& mesh : scene.meshes) {  // textures need coordinates, the normal map needs tangents
    if (mesh.material != 0) continue;
    for (const Vec3 p : mesh.positions) mesh.uv[0].push_back({p.x, p.y + p.z});
    mesh.tangents.assign(mesh.positions.size(), {1, 0, 0, -1});
  }
  Mesh& mesh = scene.meshes[0];
  mesh.uv[1] = mesh.uv[0];
  mesh.colours.assign(mesh.positions.size(), {0.5f, 1, 0.25f, 1});
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::directional, sun.name = "sun";
  sun.direction = normalize(Vec3{1, -2, 3}), sun.intensity = {3, 2, 1};
  PunctualLight point;
  point.name = "point", point.position = {1, 2, 3}, point.intensity = {0, 5, 0};
  scene.lights.insert(scene.lights.end(), {sun, point});
  scene.cameras.push_back(look_at({3, 4, 5}, {0, 1, 0}, 0.7f));
  return scene;
}

void expect_near(Vec3 a, Vec3 b, const std::string& what) {
  const float limit = 4e-6f * std::max(1.0f, std::max(length(a), length(b)));
  EXPECT_LE(length(a - b), limit) << what;
}

void expect_same_texture(const Texture& x, const Texture& y) {
  EXPECT_EQ(x.wrap_u, y.wrap_u);
  EXPECT_EQ(x.wrap_v, y.wrap_v);
  EXPECT_EQ(x.magnify_linear, y.magnify_linear);
  EXPECT_EQ(x.minify_linear, y.minify_linear);
  EXPECT_EQ(x.mip_filter, y.mip_filter);
  EXPECT_EQ(x.image->srgb, y.image->srgb) << x.name;
  EXPECT_EQ(x.image->levels.size(), y.image->levels.size());
  EXPECT_EQ(x.image->rgba, y.image->rgba) << x.name;
}

void expect_same_slot(const Scene& scene_a, const TextureSlot& a, const Scene& scene_b, const TextureSlot& b) {
  ASSERT_EQ(a.texture < 0, b.texture < 0);
  if (a.texture < 0) return;
  expect_near({a.a, a.b, a.c}, {b.a, b.b, b.c}, "texture transform");
  expect_near({a.d, a.offset.x, a.offset.y}, {b.d, b.offset.x, b.offset.y}, "texture transform");
  expect_same_texture(scene_a.textures[static_cast<std::size_t>(a.texture)],
                      scene_b.textures[static_cast<std::size_t>(b.texture)]);
}

void expect_same_material(const Scene& a, const Material& x, const Scene& b, const Material& y) {
  expect_near({x.base_colour.x, x.base_colour.y, x.base_colour.z}, {y.base_colour.x, y.base_colour.y, y.base_colour.z},
              x.name + " base colour");
  EXPECT_EQ(x.base_colour.w, y.base_colour.w);
  EXPECT_EQ(x.metallic, y.metallic) << x.name;
  EXPECT_EQ(x.roughness, y.roughness) << x.name;
  expect_near(x.emission, y.emission, x.name + " emission");
  expect_near(x.dielectric_f0, y.dielectric_f0, x.name + " f0");
  EXPECT_EQ(x.dielectric_f90, y.dielectric_f90) << x.name;
  EXPECT_EQ(x.alpha_mode, y.alpha_mode);
  EXPECT_EQ(x.alpha_cutoff, y.alpha_cutoff);
  EXPECT_EQ(x.double_sided, y.double_sided);
  EXPECT_EQ(x.normal_scale, y.normal_scale);
  expect_same_slot(a, x.base_colour_texture, b, y.base_colour_texture);
  expect_same_slot(a, x.normal_texture, b, y.normal_texture);
  expect_same_slot(a, x.emissive_texture, b, y.emissive_texture);
}

// The reader orders materials and textures by their use: they are compared where they are used.
void expect_same_meshes(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    const Mesh &x = a.meshes[m], &y = b.meshes[m];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.indices, y.indices) << x.name;
    ASSERT_EQ(x.positions.size(), y.positions.size()) << x.name;
    ASSERT_EQ(x.normals.size(), y.normals.size());
    for (std::size_t i = 0; i < x.positions.size(); ++i) {
      expect_near(x.positions[i], y.positions[i], x.name);
      expect_near(x.normals[i], y.normals[i], x.name);
    }
    EXPECT_EQ(x.uv[0].size(), y.uv[0].size());
    EXPECT_EQ(x.uv[1].size(), y.uv[1].size());
    EXPECT_EQ(x.colours.size(), y.colours.size());
    EXPECT_EQ(x.tangents.size(), y.tangents.size()) << x.name;
    expect_same_material(a, a.materials[x.material], b, b.materials[y.material]);
  }
}

void expect_same_lights_and_cameras(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    const PunctualLight &x = a.lights[i], &y = b.lights[i];
    EXPECT_EQ(x.kind, y.kind);
    expect_near(x.intensity, y.intensity, x.name + " intensity");
    if (x.kind != PunctualLight::Kind::directional) expect_near(x.position, y.position, x.name + " position");
    if (x.kind != PunctualLight::Kind::point) expect_near(x.direction, y.direction, x.name + " direction");
    if (x.kind != PunctualLight::Kind::spot) continue;
    EXPECT_NEAR(x.cos_inner, y.cos_inner, 1e-6f);
    EXPECT_NEAR(x.cos_outer, y.cos_outer, 1e-6f);
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    expect_near(a.cameras[i].eye, b.cameras[i].eye, "eye");
    expect_near(a.cameras[i].forward, b.cameras[i].forward, "forward");
    expect_near(a.cameras[i].up, b.cameras[i].up, "up");
    EXPECT_EQ(a.cameras[i].vertical_fov, b.cameras[i].vertical_fov);
  }
}

void expect_same(const Scene& a, const Scene& b) {
  expect_same_meshes(a, b);
  expect_same_lights_and_cameras(a, b);
}

Scene written_and_read(const Scene& scene, const fs::path& path) {
  const Status written = write_gltf(scene, path);
  EXPECT_TRUE(written.has_value()) << (written.has_value() ? "" : written.error().message);
  Result<Scene> again = load_scene(path);
  EXPECT_TRUE(again.has_value()) << (again.has_value() ? "" : again.error().message);
  if (!again) return {};
  EXPECT_TRUE(again->warnings.empty()) << again->warnings.front();
  return std::move(*again);
}

TEST(GltfWriter, what_is_written_is_read_again) {
  for (const char* name : {"rich.glb", "rich.gltf"})
    expect_same(rich_scene(), written_and_read(rich_scene(), scratch(name)));
}

TEST(GltfWriter, every_recipe_survives_the_way_through_a_file) {
  const std::pair<const char*, std::map<std::string, std::string>> recipes[] = {
      {"ring", {}},
      {"gallery", {{"detail", "0.01"}}},
      {"lights", {{"count", "50"}}},
      {"lamps", {{"count", "203"}, {"textured", "1"}}},
      {"lamps", {{"count", "17"}, {"matte", "1"}}}};
  for (const auto& [name, parameters] : recipes) {
    const Scene scene = *make_recipe(name, parameters);
    expect_same(scene, written_and_read(scene, scratch(std::string(name) + ".glb")));
  }
}

TEST(GltfWriter, the_comparison_sees_a_difference) {
  const Scene scene = rich_scene();
  Scene other = written_and_read(scene, scratch("other.glb"));
  other.meshes[0].positions[0].x += 1e-4f;
  other.materials[0].roughness += 1e-4f;
  EXPECT_GT(length(other.meshes[0].positions[0] - scene.meshes[0].positions[0]),
            4e-6f * length(scene.meshes[0].positions[0]));
  EXPECT_NE(other.materials[0].roughness, scene.materials[0].roughness);
}

Json document_of(const fs::path& gltf) {
  std::ifstream file(gltf);
  return Json::parse(file);
}

TEST(GltfWriter, documents_keep_the_rules_of_gltf) {
  ASSERT_TRUE(write_gltf(rich_scene(), scratch("rules.gltf")).has_value());
  const Json document = document_of(scratch("rules.gltf"));
  const std::size_t size = document["buffers"][0]["byteLength"];
  EXPECT_EQ(size, fs::file_size(scratch("rules.bin")));
  for (const Json& view : document["bufferViews"]) {
    const std::size_t offset = view["byteOffset"], bytes = view["byteLength"];
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_LE(offset + bytes, size);
    EXPECT_TRUE(view["target"] == 34962 || view["target"] == 34963);
  }
  std::set<std::string> names;
  for (const char* list : {"materials", "meshes"}) {
    names.clear();
    for (const Json& item : document[list]) EXPECT_TRUE(names.insert(item["name"]).second) << item["name"];
  }
  for (const Json& mesh : document["meshes"]) {
    const Json& position = document["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    EXPECT_EQ(position["min"].size(), 3u);
    EXPECT_EQ(position["max"].size(), 3u);
  }
  const std::set<std::string> used = document["extensionsUsed"];
  EXPECT_EQ(used, (std::set<std::string>{"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior",
                                         "KHR_materials_specular", "KHR_texture_transform"}));
}

TEST(GltfWriter, a_scene_without_anything_is_still_valid) {
  Scene empty;
  const Scene again = written_and_read(empty, scratch("empty.glb"));
  EXPECT_TRUE(again.meshes.empty());
}

TEST(GltfWriter, failures_are_one_sentence_and_leave_no_file) {
  const Scene scene = *make_recipe("ring", {});
  for (const fs::path& path :
       {scratch("scene.obj"), scratch("no/such/folder/scene.glb"), scratch("no/such/scene.gltf")}) {
    const Status status = write_gltf(scene, path);
    ASSERT_FALSE(status.has_value()) << path;
    EXPECT_NE(status.error().message.find(path.parent_path().string()), std::string::npos);
    EXPECT_FALSE(fs::exists(path));
  }
  Scene bad = scene;
  bad.meshes[0].name = "\xff\xfe";
  EXPECT_FALSE(write_gltf(bad, scratch("bad.glb")).has_value());
  EXPECT_FALSE(fs::exists(scratch("bad.glb")));
  for (const auto& entry : fs::directory_iterator(scratch("").parent_path())) {
    EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos) << entry.path();
  }
}

const Mesh& mesh_named(const Scene& scene, const std::string& name) {
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.name == name) return mesh;
  }
  ADD_FAILURE() << name;
  return scene.meshes.front();
}

TEST(GltfWriter, motion_comes_back) {
  Scene scene = *make_recipe("cornell", {{"motion", "1"}});
  const fs::path path = scratch("motion.glb");
  ASSERT_TRUE(write_gltf(scene, path).has_value());
  Result<Scene> read = load_scene(path);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_TRUE(read->warnings.empty());
  ASSERT_NE(read->animation, nullptr);
  EXPECT_EQ(read->animation->duration(), scene.animation->duration());
  const auto near = [](Vec3 a, Vec3 b) { return length(a - b) <= 1e-5f; };  // some roundings of metres
  Vec3 last{0, 0, 0};
  for (const double time : {0.0, 1.3, 4.0, 7.9}) {
    ASSERT_TRUE(pose_scene(scene, time).has_value());
    ASSERT_TRUE(pose_scene(*read, time).has_value());
    for (const Mesh& mesh : scene.meshes) {
      const Mesh& same = mesh_named(*read, mesh.name);
      ASSERT_EQ(same.positions.size(), mesh.positions.size());
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) ASSERT_TRUE(near(same.positions[i], mesh.positions[i]));
    }
    ASSERT_EQ(read->lights.size(), 1u);
    EXPECT_TRUE(near(read->lights[0].position, scene.lights[0].position));
    EXPECT_TRUE(near(read->lights[0].direction, scene.lights[0].direction));
    ASSERT_EQ(read->cameras.size(), 2u);
    EXPECT_TRUE(near(read->cameras[1].eye, scene.cameras[1].eye));
    const Vec3 corner = mesh_named(*read, "short block").positions[0];
    EXPECT_FALSE(near(corner, last));  // else nothing has moved
    last = corner;
  }
}

}  // namespace
}  // namespace luciole
