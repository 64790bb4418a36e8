// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scene/file_access.h"
#include "scene/gltf_test_files.h"
#include "scene/triangulate.h"

namespace luciole::test {
namespace {

// An OBJ file with files beside it.
Result<Scene> load_text(const std::string& text, const std::map<std::string, std::string>& files = {},
                        const LoadLimits& limits = {}) {
  const FileReader reader = [&files](const std::string& path) -> Result<Bytes> {
    const auto found = files.find(path);
    if (found == files.end()) return Error{ErrorKind::bad_scene, "no such file"};
    return Bytes(found->second.begin(), found->second.end());
  };
  return load_obj({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "made.obj", reader, limits);
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjReader, reads_polygons_with_absolute_and_relative_indices) {
  const Result<Scene> scene = load_text(kSquare + "f 1 2 3 4\nf -4 -3 -2\nf 1//  2//  3//\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangle_count(), 4u);
}

TEST(ObjReader, refuses_indices_beyond_the_lists_and_names_the_line) {
  for (const char* face : {"f 1 2 5", "f 1 2 -5", "f 0 1 2", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1 2 x",
                           "f 1 2 99999999999999999999"}) {
    const Result<Scene> scene = load_text(kSquare + face);
    ASSERT_FALSE(scene) << face;
    EXPECT_EQ(scene.error().message.find("made.obj: line 5: "), 0u) << scene.error().message;
    EXPECT_NE(scene.error().message.find("OBJ_INDEX_OOB"), std::string::npos);
  }
}

TEST(ObjReader, refuses_what_is_no_number_and_no_text) {
  for (const char* vertex :
       {"v 1 2", "v 1 2 nan", "v inf 0 0", "v 1e99 0 0", "v 1 2 1.#IND", "v 1 2 3.1+2", "v 1 2 3.1x"}) {
    EXPECT_FALSE(load_text(vertex)) << vertex;
  }
  EXPECT_TRUE(load_text("v +1 .5 -2.e-3\nv 1e-99 0 0\n"));
  EXPECT_FALSE(load_text(std::string("v\0 1", 4)));
}

TEST(ObjReader, leaves_out_a_misspelt_exponent_with_one_warning) {
  const Result<Scene> scene = load_text("v 3.1+e2 2.e1 +3.1e2\nv 3.1-e2 0 1e-99\nv 1 0 0\nf 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].positions[0].x, 3.1f);
  EXPECT_EQ(scene->meshes[0].positions[0].y, 20.0f);
  EXPECT_EQ(scene->meshes[0].positions[0].z, 310.0f);
  EXPECT_EQ(scene->meshes[0].positions[1].x, 3.1f);
  ASSERT_EQ(scene->warnings.size(), 1u);
  EXPECT_NE(scene->warnings[0].find("\"3.1+e2\", line 1"), std::string::npos) << scene->warnings[0];
}

TEST(ObjReader, bounds_polygons_and_vertices) {
  std::string polygon = "f", vertices;
  for (int i = 0; i < 1024; ++i) {
    const double angle = i * 6.283185307179586 / 1025;
    vertices += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    polygon += " " + std::to_string(i + 1);
  }
  const Result<Scene> scene = load_text(vertices + polygon);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangle_count(), 1022u);
  EXPECT_FALSE(load_text(vertices + polygon + " 1"));
  LoadLimits limits;
  limits.vertices = 10;
  EXPECT_TRUE(load_text(kSquare + "f 1 2 3 4\n", {}, limits));
  EXPECT_FALSE(load_text(kSquare + "f 1 2 3 4\nf 1 2 3 4\n", {}, limits));
}

TEST(ObjReader, joins_lines_that_end_in_a_backslash) {
  const Result<Scene> scene = load_text("v 0 0 0\r\nv 1 \\\r\n 0 0\r\nv 1 1 0 # corner\r\nf 1 2 \\\n3");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangle_count(), 1u);
}

TEST(ObjReader, maps_phong_to_metallic_roughness) {
  const std::string mtl =
      "newmtl dull wall\nKd .1 .2 .3\nNs 8\nKs 0 0 0\n"
      "newmtl shiny\nKd .5 .5 .5\nNs 40\nKs .9 .9 .9\nd .5\n"
      "newmtl mirror\nKd 0 0 0\nKs .95 .9 .8\nillum 3\n"
      "newmtl lamp\nKd .8 .8 .8\nKe 17 12 4\n";
  const Result<Scene> scene = load_text(
      "mtllib all of it.mtl\n" + kSquare + "usemtl dull wall\nf 1 2 3\nusemtl lamp\nf 1 3 4\nusemtl none\nf 1 2 4\n",
      {{"all of it.mtl", mtl}});
  ASSERT_TRUE(scene) << scene.error().message;
  std::map<std::string, Material> materials;
  for (const Material& material : scene->materials) materials[material.name] = material;
  EXPECT_FLOAT_EQ(materials["dull wall"].roughness, 1);
  EXPECT_FLOAT_EQ(materials["dull wall"].base_colour.z, .3f);
  EXPECT_NEAR(materials["shiny"].roughness, .4671f, 1e-4f);  // (2 / 42)^(1/4)
  EXPECT_EQ(materials["shiny"].alpha_mode, AlphaMode::blend);
  EXPECT_EQ(materials["mirror"].metallic, 1);
  EXPECT_EQ(materials["mirror"].base_colour.y, .9f);
  EXPECT_EQ(materials["lamp"].emission.x, 17);
  ASSERT_EQ(scene->warnings.size(), 1u);
  EXPECT_NE(scene->warnings[0].find("none"), std::string::npos);
}

TEST(ObjReader, does_without_material_files_and_textures_it_may_not_read) {
  const Result<Scene> missing = load_text("mtllib a.mtl\nmtllib b.mtl\n" + kSquare + "usemtl m\nf 1 2 3\n");
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->warnings.size(), 2u);  // one for material files, one for materials
  const Result<Scene> outside =
      load_text("mtllib a.mtl\n" + kSquare + "usemtl m\nf 1 2 3\n",
                {{"a.mtl", "newmtl m\nmap_Kd ..\\..\\secret.png\n"}, {"../../secret.png", "x"}});
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->textures.size(), 0u);
  EXPECT_EQ(outside->warnings.size(), 1u);
}

TEST(ObjReader, turns_texture_coordinates_upside_down) {
  const Bytes png = png_file(1, 2, {255, 0, 0, 255, 0, 0, 255, 255});
  const Result<Scene> scene = load_text(
      "mtllib a.mtl\n" + kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3\n",
      {{"a.mtl", "newmtl m\nmap_Kd -s 2 3 -o .1 .2 a.png\n"}, {"a.png", std::string(png.begin(), png.end())}});
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].uv[0][2].y, 0);  // v = 1 is the top row
  // (1, 0) of the file, scaled and shifted to (2.1, 0.2), then turned: (2.1, 0.8).
  const Vec2 uv = scene->materials[0].base_colour_texture.transform(scene->meshes[0].uv[0][1]);
  EXPECT_NEAR(uv.x, 2.1f, 1e-6f);
  EXPECT_NEAR(uv.y, 0.8f, 1e-6f);
}

// Area with sign of the triangles of a polygon in the plane z = 0; the sum of absolute areas by `absolute`.
double area(const std::vector<Vec3>& corners, bool absolute) {
  double sum = 0;
  const std::vector<std::uint32_t> list = triangulate(corners);
  for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
    const double a = 0.5 * cross(corners[list[i + 1]] - corners[list[i]], corners[list[i + 2]] - corners[list[i]]).z;
    sum += absolute ? std::abs(a) : a;
  }
  return sum;
}

TEST(Triangulate, covers_concave_polygons_once) {
  const std::vector<Vec3> arrow = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 3, 0}, {0, 2, 0}, {0.5f, 1, 0}};
  EXPECT_EQ(triangulate(arrow).size(), 12u);
  EXPECT_NEAR(area(arrow, false), area(arrow, true), 1e-6);
  // A fan from the first corner covers parts twice: the two sums differ.
  double fan = 0, fan_absolute = 0;
  for (std::size_t i = 1; i + 1 < arrow.size(); ++i) {
    const double a = 0.5 * cross(arrow[i] - arrow[0], arrow[i + 1] - arrow[0]).z;
    fan += a, fan_absolute += std::abs(a);
  }
  EXPECT_GT(fan_absolute - fan, 0.1);
}

TEST(Triangulate, ends_on_polygons_that_cross_themselves) {
  std::vector<Vec3> star;
  for (int i = 0; i < 1024; ++i) {
    const float angle = static_cast<float>(i) * 2.4f;
    star.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
  }
  EXPECT_EQ(triangulate(star).size(), 3u * 1022u);
  EXPECT_EQ(triangulate(std::vector<Vec3>(100, Vec3(1, 1, 1))).size(), 3u * 98u);
}

}  // namespace
}  // namespace luciole::test
