// SPDX-License-Identifier: Apache-2.0
#include "scene/framing_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "scene/box_scene.h"
#include "scene/line_of_sight.h"
#include "scene/load_scene.h"
#include "scene/room_or_object.h"

namespace luciole::test {
namespace {

bool holds(const Bounds& bounds, Vec3 p) {
  return p.x > bounds.low.x && p.x < bounds.high.x && p.y > bounds.low.y && p.y < bounds.high.y && p.z > bounds.low.z &&
         p.z < bounds.high.z;
}

bool stands_inside(const Scene& scene) { return holds(scene.bounds(), framing_camera(scene).eye); }

Scene scaled(Scene scene, float factor) {
  for (Mesh& mesh : scene.meshes) {
    for (Vec3& position : mesh.positions) position = position * factor;
  }
  return scene;
}

Scene box(bool inwards) {
  Scene scene;
  add_box(scene, {-3, 0, -2}, {3, 3, 2}, inwards);
  return scene;
}

// Walls of some thickness, outside as well as inside, with what a hall has in it.
Scene hall(int pillars_in_a_row) {
  Scene scene;
  add_box(scene, {-3.2f, -0.2f, -2.2f}, {3.2f, 3.2f, 2.2f}, false);
  add_box(scene, {-3, 0, -2}, {3, 3, 2}, true);
  for (int i = 0; i < pillars_in_a_row; ++i) {
    const float x = -2.5f + static_cast<float>(i);
    for (const float z : {-1.6f, 1.2f}) add_box(scene, {x, 0, z}, {x + 0.4f, 3, z + 0.4f}, false);
  }
  return scene;
}

// In file order, blocks of triangles are small boxes of which most are missed; shuffled, each is as large as the scene.
TEST(LineOfSight, does_not_depend_on_the_order_of_triangles) {
  Scene ordered;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 low(static_cast<float>(i % 10), static_cast<float>(i / 10 % 10), static_cast<float>(i / 100));
    add_box(ordered, low, low + Vec3(0.4f, 0.3f, 0.2f), false);
  }
  Scene shuffled;
  shuffled.meshes.emplace_back();
  Mesh& all = shuffled.meshes.front();
  for (std::size_t i = 0, k = 0; i < 12000; ++i, k = (k + 4999) % 12000) {
    const Mesh& box = ordered.meshes[k / 12];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      all.indices.push_back(static_cast<std::uint32_t>(all.positions.size()));
      all.positions.push_back(box.positions[box.indices[k % 12 * 3 + corner]]);
    }
  }
  std::vector<SightLine> lines;
  for (const Vec3 direction : even_directions(500)) lines.push_back({{4.7f, 4.65f, 4.6f}, direction});
  for (const Vec3 axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {  // in the planes of the boxes' sides
    for (const float sign : {1.0f, -1.0f})
      lines.push_back({{4 + 0.5f * axis.x, 4 + 0.5f * axis.y, 4 + 0.5f * axis.z}, axis * sign});
  }
  const std::vector<Sight> expected = look_along(ordered, lines), found = look_along(shuffled, lines);
  std::size_t met = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    EXPECT_EQ(expected[k].distance, found[k].distance);
    met += found[k].met();
  }
  EXPECT_GT(met, 100u);
  EXPECT_LT(met, 500u);
  for (std::size_t k = 500; k < lines.size(); ++k) EXPECT_TRUE(found[k].met());
}

TEST(FramingCamera, stands_inside_rooms_and_outside_objects) {
  EXPECT_TRUE(stands_inside(box(true)));
  EXPECT_FALSE(stands_inside(box(false)));
  EXPECT_TRUE(stands_inside(hall(6)));
}

TEST(FramingCamera, stands_outside_a_hollow_shell_though_its_middle_is_closed) { EXPECT_FALSE(stands_inside(hall(0))); }

TEST(FramingCamera, stands_outside_what_is_too_low_to_stand_in_unless_there_are_only_backs) {
  EXPECT_FALSE(stands_inside(scaled(hall(6), 0.3f)));
  EXPECT_TRUE(stands_inside(scaled(box(true), 0.3f)));
}

TEST(FramingCamera, looks_at_the_fronts_of_what_is_open) {
  for (const Vec3 normal : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, 0)}) {
    Scene sheet;
    sheet.materials.emplace_back();
    const Vec3 side = cross(Vec3(0, 1, 0), normal);
    Mesh mesh;
    mesh.positions = {Vec3(0, 0, 0), side, Vec3(0, 1, 0)};
    mesh.indices = {0, 1, 2};
    sheet.meshes.push_back(mesh);
    EXPECT_LT(dot(framing_camera(sheet).forward, normal), 0);
  }
}

TEST(FramingCamera, holds_an_object_whole_and_not_smaller_than_it_need_be) {
  for (const Vec3 high : {Vec3(1, 1, 1), Vec3(30, 1, 1), Vec3(1, 20, 1), Vec3(1, 1, 40)}) {
    Scene scene;
    add_box(scene, {0, 0, 0}, high, false);
    const Camera camera = framing_camera(scene);
    EXPECT_NEAR(dot(camera.right, camera.up), 0, 1e-6f);
    const float slope = std::tan(0.5f * camera.vertical_fov);
    float furthest = 0;  // from the picture's middle, 1 at the border of a picture of 4:3
    for (const Vec3 corner : scene.meshes[0].positions) {
      const Vec3 from_eye = corner - camera.eye;
      const float depth = dot(from_eye, camera.forward);
      ASSERT_GT(depth, 0);
      furthest = std::max({furthest, std::abs(dot(from_eye, camera.right)) / (depth * slope * 4 / 3),
                           std::abs(dot(from_eye, camera.up)) / (depth * slope)});
    }
    EXPECT_LT(furthest, 1);
    EXPECT_GT(furthest, 0.9f);
  }
}

TEST(FramingCamera, knows_rooms_and_objects_among_real_scenes) {
  const char* folder = std::getenv("LUCIOLE_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "LUCIOLE_SCENES is not set";
  const std::pair<const char*, bool> expected[] = {{"conference/conference.gltf", true},
                                                   {"cornell/CornellBox-Original.gltf", true},
                                                   {"dabrovic-sponza/sponza.gltf", true},
                                                   {"holodeck/holodeck.gltf", true},
                                                   {"lost-empire/lost_empire.gltf", true},
                                                   {"sibenik/sibenik.gltf", true},
                                                   {"sponza/sponza.gltf", true},
                                                   {"gltf-samples/blender-io/14_emission_strength/"
                                                    "14_emission_strength.gltf",
                                                    false},
                                                   {"gltf-samples/khronos/BoomBox/BoomBox.gltf", false},
                                                   {"gltf-samples/khronos/DamagedHelmet/DamagedHelmet.glb", false},
                                                   {"mori-knob/mori_knob.gltf", false},
                                                   {"pica-pica/scene.gltf", false},
                                                   {"roughness-scale/scene.gltf", false},
                                                   {"sports-car/sports_car.gltf", false}};
  for (const auto& [file, room] : expected) {
    const Result<Scene> scene = load_scene(std::filesystem::path(folder) / file);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(is_room(*scene), room) << file;
  }
}

}  // namespace
}  // namespace luciole::test
