// SPDX-License-Identifier: Apache-2.0
// Real scenes, importer samples and broken files, where $LUCIOLE_SCENES says they are. With the variable set a missing
// file is a failure; without it these tests are skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "scene/emissive_triangles.h"
#include "scene/load_scene.h"

namespace luciole::test {
namespace {

namespace fs = std::filesystem;

class SampleFiles : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("LUCIOLE_SCENES");
    if (folder == nullptr) GTEST_SKIP() << "LUCIOLE_SCENES is not set";
    root_ = folder;
    ASSERT_TRUE(fs::is_directory(root_)) << root_;
  }

  // Files below a folder with one of the extensions, in order.
  std::vector<fs::path> files(const std::string& folder, const std::set<std::string>& extensions) const {
    std::vector<fs::path> result;
    for (const auto& entry : fs::recursive_directory_iterator(root_ / folder)) {
      if (entry.is_regular_file() && extensions.contains(entry.path().extension().string()))
        result.push_back(entry.path());
    }
    std::sort(result.begin(), result.end());
    EXPECT_FALSE(result.empty()) << folder;
    return result;
  }

  void expect_triangles(const std::string& file, std::uint64_t triangles) const {
    const Result<Scene> scene = load_scene(root_ / file);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->triangle_count(), triangles) << file;
  }

  fs::path root_;
};

TEST_F(SampleFiles, scenes_have_the_triangles_that_their_readme_counts) {
  expect_triangles("sponza/sponza.gltf", 262233);
  expect_triangles("sibenik/sibenik.gltf", 75283);
  expect_triangles("sibenik/sibenik.obj", 75284);
  expect_triangles("conference/conference.gltf", 331179);
  expect_triangles("dabrovic-sponza/sponza.gltf", 66450);
  expect_triangles("pica-pica/scene.gltf", 76274);
  expect_triangles("roughness-scale/scene.gltf", 51200);
  expect_triangles("mori-knob/mori_knob.gltf", 11970);
  expect_triangles("holodeck/holodeck.gltf", 4011);
  for (const char* name : {"Original", "Mirror"}) {
    expect_triangles(std::string("cornell/CornellBox-") + name + ".gltf", 36);
    expect_triangles(std::string("cornell/CornellBox-") + name + ".obj", 36);
  }
}

TEST_F(SampleFiles, lamps_are_found) {
  const std::pair<const char*, std::size_t> expected[] = {{"lost-empire/lost_empire.gltf", 1798},
                                                          {"sports-car/sports_car.gltf", 3104},
                                                          {"holodeck/holodeck.gltf", 8},
                                                          {"cornell/CornellBox-Original.obj", 2},
                                                          {"cornell/CornellBox-Glossy.obj", 0}};
  for (const auto& [file, count] : expected) {
    const Result<Scene> scene = load_scene(root_ / file);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(emissive_triangles(*scene).size(), count) << file;
  }
}

TEST_F(SampleFiles, obj_and_converted_gltf_have_the_same_materials) {
  for (const std::string name : {"cornell/CornellBox-Original", "cornell/CornellBox-Mirror", "sibenik/sibenik"}) {
    const Result<Scene> obj = load_scene(root_ / (name + ".obj")), gltf = load_scene(root_ / (name + ".gltf"));
    ASSERT_TRUE(obj) << obj.error().message;
    ASSERT_TRUE(gltf) << gltf.error().message;
    for (const Material& expected : gltf->materials) {
      const auto found = std::find_if(obj->materials.begin(), obj->materials.end(),
                                      [&](const Material& m) { return m.name == expected.name; });
      ASSERT_NE(found, obj->materials.end()) << expected.name;
      EXPECT_NEAR(found->base_colour.x, expected.base_colour.x, 1e-4f) << expected.name;
      EXPECT_NEAR(found->roughness, expected.roughness, 1e-4f) << expected.name;
      EXPECT_EQ(found->metallic, expected.metallic) << expected.name;
      EXPECT_NEAR(found->emission.y, expected.emission.y, 1e-3f) << expected.name;
      EXPECT_EQ(found->base_colour_texture.texture >= 0, expected.base_colour_texture.texture >= 0) << expected.name;
    }
  }
}

TEST_F(SampleFiles, every_valid_gltf_sample_loads) {
  std::set<std::string> without_triangles;
  for (const fs::path& file : files("gltf-samples", {".gltf", ".glb"})) {
    const Result<Scene> scene = load_scene(file);
    ASSERT_TRUE(scene) << scene.error().message;
    if (scene->triangle_count() == 0) without_triangles.insert(file.stem().string());
  }
  // Nothing to draw by default, or points and lines alone (modes 00 to 03 and, indexed, 07 to 10).
  const std::set<std::string> expected = {"00_empty_scene",        "00_no_nodes",           "00_no_scenes",
                                          "Mesh_PrimitiveMode_00", "Mesh_PrimitiveMode_01", "Mesh_PrimitiveMode_02",
                                          "Mesh_PrimitiveMode_03", "Mesh_PrimitiveMode_07", "Mesh_PrimitiveMode_08",
                                          "Mesh_PrimitiveMode_09", "Mesh_PrimitiveMode_10"};
  EXPECT_EQ(without_triangles, expected);
}

TEST_F(SampleFiles, triangle_modes_draw_the_same_square) {
  for (const char* mode : {"04", "05", "06", "11", "12", "13", "14", "15"}) {
    const Result<Scene> scene =
        load_scene(root_ / (std::string("gltf-samples/khronos/PrimitiveMode/Mesh_PrimitiveMode_") + mode + ".gltf"));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->triangle_count(), 2u) << mode;
    const Mesh& mesh = scene->meshes.at(0);
    Vec3 doubled_area(0, 0, 0);
    for (std::size_t i = 0; i < 6; i += 3) {
      const Vec3 a = mesh.positions[mesh.indices[i]];
      doubled_area += cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
    }
    const Vec3 size = scene->bounds().high - scene->bounds().low;
    EXPECT_NEAR(doubled_area.z, 2 * size.x * size.y, 1e-5f) << mode;  // both wind counter-clockwise
  }
}

TEST_F(SampleFiles, obj_samples_load_except_those_that_cannot) {
  std::set<std::string> refused;
  for (const fs::path& file : files("obj-samples", {".obj"})) {
    if (!load_scene(file)) refused.insert(file.filename().string());
  }
  EXPECT_EQ(refused, (std::set<std::string>{"box_UTF16BE.obj"}));  // UTF-16 text
}

nlohmann::json report_of(const fs::path& file) {
  std::ifstream stream(file.string() + ".report.json");
  return nlohmann::json::parse(stream);
}

bool has_errors(const nlohmann::json& report) {
  for (const auto& message : report["issues"]["messages"]) {
    if (message["severity"] == 0) return true;
  }
  return false;
}

TEST_F(SampleFiles, files_that_the_validator_passes_load) {
  // The validator does not draw. We refuse: types of accessors and lights that nobody knows, a file for a newer reader,
  // the network, an opening angle beyond half a turn, drawn buffers without bytes, and keys of animations without
  // bytes.
  const std::set<std::string> exceptions = {
      "accessor/unknown_type.gltf",   "asset/min_version_valid.gltf", "buffer/non_relative_uri.gltf",
      "camera/perspective_yfov.gltf", "root/named_objects.gltf",      "root/unused_objects.gltf",
      "light/unknown_type.gltf",      "animation/valid.gltf",         "skin/ignored_animated_transform.gltf"};
  int refused = 0, with_errors = 0;
  std::set<std::string> wrongly_refused;
  for (const fs::path& file : files("malformed/khronos-validator", {".gltf", ".glb"})) {
    const bool bad = has_errors(report_of(file));
    const bool loads = load_scene(file).has_value();
    with_errors += bad;
    refused += bad && !loads;
    if (!bad && !loads) wrongly_refused.insert(file.parent_path().filename().string() + "/" + file.filename().string());
  }
  EXPECT_EQ(wrongly_refused, exceptions);
  EXPECT_EQ(with_errors, 243);
  EXPECT_GE(refused, 120);  // the others are wrong in what we do not read: bounds, animations, alignment, extensions
}

TEST_F(SampleFiles, refusals_use_the_code_of_the_validator) {
  for (const char* name : {"base/data/node/node_loop.gltf", "base/data/mesh_data/index_buffer_oob.gltf",
                           "base/data/glb/invalid_version.glb", "base/data/buffer_view/invalid_length.gltf"}) {
    const fs::path file = root_ / "malformed/khronos-validator" / name;
    const Result<Scene> scene = load_scene(file);
    ASSERT_FALSE(scene) << name;
    const nlohmann::json report = report_of(file);
    bool named = false;
    for (const auto& message : report["issues"]["messages"]) {
      named = named || scene.error().message.find(message["code"].get<std::string>()) != std::string::npos;
    }
    EXPECT_TRUE(named) << scene.error().message;
    EXPECT_EQ(scene.error().message.find(file.filename().string()), 0u) << scene.error().message;
  }
}

TEST_F(SampleFiles, names_with_invalid_are_refused) {
  for (const fs::path& file : files("malformed/magnum-plugins", {".gltf", ".glb"})) {
    const Result<Scene> scene = load_scene(file);
    if (file.filename().string().find("invalid") != std::string::npos) {
      EXPECT_FALSE(scene) << file;
    }
  }
}

TEST_F(SampleFiles, other_broken_files_are_refused_or_survived) {
  std::set<std::string> loaded;
  for (const std::string folder : {"malformed/assimp", "malformed/gltf-test-models", "malformed/required-draco"}) {
    for (const fs::path& file : files(folder, {".gltf", ".glb", ".obj"})) {
      if (load_scene(file)) loaded.insert(file.filename().string());
    }
  }
  for (const char* name : {"IndexOutOfRange.gltf", "AllIndicesOutOfRange.gltf", "RecursiveNodes.gltf", "BoomBox.gltf",
                           "BoxWithInfinites.glb", "malformed.obj"}) {
    EXPECT_FALSE(loaded.contains(name)) << name;
  }
}

}  // namespace
}  // namespace luciole::test
