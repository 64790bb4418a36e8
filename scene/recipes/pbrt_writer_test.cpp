// SPDX-License-Identifier: Apache-2.0
#include "scene/pbrt_writer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <sstream>

#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

fs::path scratch(const std::string& name) {
  const fs::path folder = fs::path(LUCIOLE_SCRATCH_DIR) / "written_pbrt";
  fs::create_directories(folder);
  return folder / name;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Material matte(const std::string& name, Vec4 colour) {
  Material material;
  material.name = name;
  material.base_colour = colour;
  material.metallic = 0;
  material.dielectric_f0 = {0, 0, 0}, material.dielectric_f90 = 0;
  return material;
}

Mesh triangle(std::uint32_t material) {
  Mesh mesh;
  mesh.name = "triangle", mesh.material = material;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.indices = {0, 1, 2, 0, 1, 1};  // the second has no area
  return mesh;
}

// Everything that can be written, once.
Scene whole_scene() {
  Scene scene;
  scene.materials = {matte("a \"wall\"", {0.5f, 0.25f, 2, 1}), matte("glow", {0, 0, 0, 1}), {}};
  scene.materials[1].emission = {3, 2, 0};
  scene.materials[2].name = "mirror", scene.materials[2].roughness = 0.5f;
  scene.meshes = {triangle(0), triangle(1), triangle(2)};
  PunctualLight point;
  point.name = "bulb", point.position = {1, 2, 3}, point.intensity = {4, 5, 6};
  PunctualLight sun = point;
  sun.kind = PunctualLight::Kind::directional, sun.direction = {0, -1, 0};
  scene.lights = {point, sun};
  scene.cameras = {look_at({0, 0, 5}, {0, 0, 0}, 1.5707964f)};
  return scene;
}

std::string written(const Scene& scene, const PbrtPicture& picture = {}) {
  const fs::path path = scratch("scene.pbrt");
  fs::remove(path);
  const Status status = write_pbrt(scene, picture, path);
  EXPECT_TRUE(status.has_value()) << status.error().message;
  return content(path);
}

TEST(PbrtWriter, a_scene_is_written_line_by_line) {
  const std::string expected = R"(# Written by Luciole for pbrt-v4. Radiance [W/(m^2 sr)] comes out 1:1.
ColorSpace "srgb"
Film "rgb" "integer xresolution" [ 640 ] "integer yresolution" [ 360 ]
    "string filename" [ "scene.exr" ] "bool savefp16" [ false ]
    "string sensor" [ "cie1931" ] "float iso" [ 100 ]
PixelFilter "box" "float xradius" [ 0.5 ] "float yradius" [ 0.5 ]
Sampler "zsobol" "integer pixelsamples" [ 64 ]
Integrator "path" "integer maxdepth" [ 1 ] "string lightsampler" [ "bvh" ]
Transform [ 1 0 0 0 0 1 0 0 0 0 -1 0 0 0 5 1 ]
Camera "perspective" "float fov" [ 90 ]
WorldBegin
LightSource "point" "rgb I" [ 4 5 6 ] "point3 from" [ 1 2 3 ]
LightSource "distant" "rgb L" [ 4 5 6 ] "point3 from" [ 0 0 0 ] "point3 to" [ 0 -1 0 ]
AttributeBegin  # "a \"wall\""
  Material "diffuse" "rgb reflectance" [ 0.5 0.25 1 ]
  Shape "plymesh" "string filename" [ "scene_0.ply" ]
AttributeEnd
AttributeBegin  # "glow"
  Material "diffuse" "rgb reflectance" [ 0 0 0 ]
  AreaLightSource "diffuse" "rgb L" [ 3 2 0 ] "bool twosided" [ false ]
  Shape "plymesh" "string filename" [ "scene_1.ply" ]
AttributeEnd
AttributeBegin  # "mirror"
  Material "conductor" "spectrum eta" [ 300 0 900 0 ] "spectrum k" [ 300 1 900 1 ]
    "float roughness" [ 0.25 ] "bool remaproughness" [ false ]
  Shape "plymesh" "string filename" [ "scene_2.ply" ]
AttributeEnd
)";
  EXPECT_EQ(written(whole_scene(), {640, 360, 1, 64}), expected);
}

TEST(PbrtWriter, both_sides_shine_where_the_material_has_two) {
  Scene scene = whole_scene();
  scene.materials[1].double_sided = true;
  EXPECT_NE(written(scene).find("\"rgb L\" [ 3 2 0 ] \"bool twosided\" [ true ]"), std::string::npos);
}

TEST(PbrtWriter, meshes_lie_beside_without_triangles_that_have_no_area) {
  written(whole_scene());
  const std::string ply = content(scratch("scene_0.ply"));
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_EQ(ply.substr(0, header.size()), header);
  EXPECT_EQ(ply.size(), header.size() + 3 * 6 * sizeof(float) + 1 + 3 * sizeof(std::uint32_t));
  const std::string face("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
  EXPECT_EQ(ply.substr(ply.size() - 13), face);
}

// The numbers in brackets behind `word`.
std::vector<float> numbers_after(const std::string& text, const std::string& word) {
  std::istringstream stream(text.substr(text.find(word) + word.size() + 2));
  std::vector<float> values;
  for (float value = 0; stream >> value;) values.push_back(value);
  return values;
}

TEST(PbrtWriter, the_camera_sees_what_lies_right_on_the_right) {
  Scene scene = whole_scene();
  const Camera& camera = scene.cameras[0] = look_at({1, 2, 3}, {-4, 1, 2}, 0.8f);
  const std::vector<float> m = numbers_after(written(scene), "Transform");
  ASSERT_EQ(m.size(), 16u);
  const Vec3 p = camera.eye + camera.right * 2 + camera.up * 3 + camera.forward * 4;
  for (std::size_t row = 0; row < 3; ++row) {  // m holds column by column
    EXPECT_NEAR(m[row] * p.x + m[4 + row] * p.y + m[8 + row] * p.z + m[12 + row], 2.0f + static_cast<float>(row),
                1e-5f);
  }
}

TEST(PbrtWriter, the_angle_is_that_of_the_shorter_side) {
  Scene scene = whole_scene();
  scene.cameras[0].vertical_fov = 2 * std::atan(0.5f);
  EXPECT_NEAR(numbers_after(written(scene, {200, 100, 1, 1}), "\"float fov\"").at(0), 53.130102f, 1e-4f);
  EXPECT_NEAR(numbers_after(written(scene, {100, 200, 1, 1}), "\"float fov\"").at(0), 28.072487f, 1e-4f);
}

TEST(PbrtWriter, what_pbrt_shows_otherwise_is_refused_by_name) {
  struct Case {
    const char *name, *reason;
    std::function<void(Scene&)> change;
  };
  const Case cases[] = {
      {"wall", "texture", [](Scene& s) { s.materials[0].normal_texture.texture = 0; }},
      {"glow", "texture", [](Scene& s) { s.materials[1].emissive_texture.texture = 0; }},
      {"wall", "opaque", [](Scene& s) { s.materials[0].alpha_mode = AlphaMode::mask; }},
      {"wall", "vertices",
       [](Scene& s) {
         s.meshes[0].colours.assign(3, {1, 1, 1, 1});
       }},
      {"wall", "Schlick",
       [](Scene& s) {
         s.materials[0].dielectric_f0 = {0.04f, 0.04f, 0.04f};
       }},
      {"wall", "Schlick", [](Scene& s) { s.materials[0].dielectric_f90 = 1; }},
      {"wall", "Schlick", [](Scene& s) { s.materials[0].metallic = 0.5f; }},
      {"wall", "Schlick", [](Scene& s) { s.materials[0].metallic_override = 1; }},
      {"mirror", "Schlick", [](Scene& s) { s.materials[2].base_colour.y = 0.9f; }},
      {"glow", "one side",
       [](Scene& s) {
         s.meshes[1].normals.assign(3, {0, 0, -1});
       }},
      {"bulb", "spot", [](Scene& s) { s.lights[0].kind = PunctualLight::Kind::spot; }},
      {"scene", "sky",
       [](Scene& s) {
         s.environment.radiance = {0, 0, 1};
       }},
  };
  const fs::path path = scratch("refused.pbrt");
  ASSERT_TRUE(write_pbrt(whole_scene(), {}, scratch("control.pbrt")).has_value());
  for (const Case& one : cases) {
    Scene scene = whole_scene();
    one.change(scene);
    const Status status = write_pbrt(scene, {}, path);
    ASSERT_FALSE(status.has_value()) << one.name << " " << one.reason;
    EXPECT_EQ(status.error().kind, ErrorKind::bad_scene);
    EXPECT_NE(status.error().message.find(one.name), std::string::npos) << status.error().message;
    EXPECT_NE(status.error().message.find(one.reason), std::string::npos) << status.error().message;
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_EQ(write_pbrt(whole_scene(), {}, scratch("scene.ply")).error().kind, ErrorKind::failed);
}

TEST(PbrtWriter, materials_without_a_mesh_do_not_matter) {
  Scene scene = whole_scene();
  scene.materials.push_back({});
  scene.materials.back().base_colour.x = 0.5f;
  EXPECT_EQ(written(scene), written(whole_scene()));
}

TEST(PbrtWriter, lamps_can_be_written_when_they_are_matte) {
  const fs::path path = scratch("lamps.pbrt");
  const Status shiny = write_pbrt(*make_recipe("lamps", {{"count", "100"}}), {}, path);
  ASSERT_FALSE(shiny.has_value());
  EXPECT_NE(shiny.error().message.find("\"polished stone\""), std::string::npos) << shiny.error().message;
  const Status matte = write_pbrt(*make_recipe("lamps", {{"count", "100"}, {"matte", "1"}}), {}, path);
  EXPECT_TRUE(matte.has_value()) << matte.error().message;
}

}  // namespace
}  // namespace luciole
