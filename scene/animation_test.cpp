// SPDX-License-Identifier: Apache-2.0
// Nodes of glTF files move as appendix C of the format says, with whatever hangs on them; what is malformed is refused.
#include "scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/gltf_test_files.h"

namespace luciole::test {
namespace {

std::size_t add_numbers(Json& file, const std::vector<float>& values, const char* type) {
  Bytes bytes(values.size() * 4);
  std::memcpy(bytes.data(), values.data(), bytes.size());
  const std::size_t components = type == std::string("SCALAR") ? 1 : static_cast<std::size_t>(type[3] - '0');
  file["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", data_uri("application/octet-stream", bytes)}});
  file["bufferViews"].push_back({{"buffer", file["buffers"].size() - 1}, {"byteLength", bytes.size()}});
  file["accessors"].push_back({{"bufferView", file["bufferViews"].size() - 1},
                               {"componentType", 5126},
                               {"count", values.size() / components},
                               {"type", type}});
  return file["accessors"].size() - 1;
}

struct Motion {
  std::size_t node;
  std::string path, interpolation;
  std::vector<float> times, values;
};

void add_motion(Json& file, const Motion& motion) {
  Json& animation = file["animations"][0];
  const std::size_t times = add_numbers(file, motion.times, "SCALAR");
  const std::size_t values = add_numbers(file, motion.values, motion.path == "rotation" ? "VEC4" : "VEC3");
  animation["samplers"].push_back({{"input", times}, {"output", values}, {"interpolation", motion.interpolation}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", motion.node}, {"path", motion.path}}}});
}

Json moving_square(const Motion& motion) {
  Json file = square_file();
  add_motion(file, motion);
  return file;
}

// Where the square's first corner, (0, 0, 0) of the mesh, or its third, (1, 1, 0), is at a time.
Vec3 corner_at(const Json& file, double time, std::size_t corner = 0) {
  Result<Scene> scene = load(file);
  EXPECT_TRUE(scene.has_value()) << scene.error().message;
  const Status posed = pose_scene(*scene, time);
  EXPECT_TRUE(posed.has_value()) << posed.error().message;
  return scene->meshes.at(0).positions.at(corner);
}

void expect_near(Vec3 a, Vec3 b) { EXPECT_LE(length(a - b), 1e-6f) << a.x << " " << a.y << " " << a.z; }

TEST(Animation, moves_a_node_linearly_and_rests_outside_its_keys) {
  const Json file = moving_square({0, "translation", "LINEAR", {1, 3}, {0, 0, 0, 4, 0, -2}});
  expect_near(corner_at(file, 0), {0, 0, 0});
  expect_near(corner_at(file, 1.5), {1, 0, -0.5f});
  expect_near(corner_at(file, 3), {4, 0, -2});
  expect_near(corner_at(file, 99), {4, 0, -2});
  EXPECT_EQ(load(file)->animation->duration(), 3);
  EXPECT_EQ(load(file)->warnings.size(), 0u);
}

TEST(Animation, steps_hold_the_key_before) {
  const Json file = moving_square({0, "translation", "STEP", {0, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0}});
  expect_near(corner_at(file, 0.99), {0, 0, 0});
  expect_near(corner_at(file, 1), {1, 0, 0});
  expect_near(corner_at(file, 1.99), {1, 0, 0});
}

// Keys at 0 and 2 s, no tangents but the first one's: 3 m/s out of it.
TEST(Animation, cubic_splines_have_the_tangents_of_their_keys_per_second) {
  const Json file = moving_square({0,
                                   "translation",
                                   "CUBICSPLINE",
                                   {0, 2},
                                   {0, 0, 0, 0, 0, 0, 3, 0, 0,  // in-tangent, value, out-tangent
                                    0, 0, 0, 1, 0, 0, 0, 0, 0}});
  expect_near(corner_at(file, 0), {0, 0, 0});
  expect_near(corner_at(file, 2), {1, 0, 0});
  // t = 1/2: (1/8) duration * tangent + (1/2) * 1 m
  expect_near(corner_at(file, 1), {0.125f * 2 * 3 + 0.5f, 0, 0});
}

TEST(Animation, turns_at_constant_speed_along_the_shorter_way) {
  const float half = std::sqrt(0.5f);
  for (const float side : {1.0f, -1.0f}) {  // a quaternion and its negative are one rotation
    const Json file = moving_square({0, "rotation", "LINEAR", {0, 3}, {0, 0, 0, 1, 0, 0, side * half, side * half}});
    const float angle = std::acos(-1.0f) / 6;  // a third of the quarter turn
    const float c = std::cos(angle), s = std::sin(angle);
    expect_near(corner_at(file, 1, 2), {c - s, c + s, 0});
    expect_near(corner_at(file, 3, 2), {-1, 1, 0});
  }
}

TEST(Animation, scales_and_mirrors_with_triangles_that_still_face_outwards) {
  const Json file = moving_square({0, "scale", "LINEAR", {0, 1}, {1, 1, 1, -1, 1, 1}});
  Result<Scene> scene = load(file);
  ASSERT_TRUE(scene.has_value());
  for (const double time : {0.0, 0.25, 1.0}) {
    ASSERT_TRUE(pose_scene(*scene, time).has_value());
    const Mesh& mesh = scene->meshes[0];
    const Vec3 a = mesh.positions[mesh.indices[0]], b = mesh.positions[mesh.indices[1]],
               c = mesh.positions[mesh.indices[2]];
    EXPECT_GT(dot(cross(b - a, c - a), mesh.normals[0]), 0) << time;
    EXPECT_FLOAT_EQ(length(mesh.normals[0]), 1.0f);
  }
}

// A light and a camera hang on a child of the node that moves; a second mesh hangs on nothing.
TEST(Animation, carries_children_lights_and_cameras_and_leaves_the_rest_alone) {
  Json file = moving_square({0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 2, 0}});
  file["nodes"] = {
      {{"mesh", 0}, {"children", {1}}},
      {{"translation", {1, 0, 0}}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
      {{"mesh", 0}}};
  file["scenes"][0]["nodes"] = {0, 2};
  file["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  file["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  Result<Scene> scene = load(file);
  ASSERT_TRUE(scene.has_value()) << scene.error().message;
  ASSERT_TRUE(pose_scene(*scene, 0.5).has_value());
  expect_near(scene->meshes[0].positions[0], {0, 1, 0});
  expect_near(scene->meshes[1].positions[0], {0, 0, 0});
  expect_near(scene->lights[0].position, {1, 1, 0});
  expect_near(scene->cameras[0].eye, {1, 1, 0});
  // A light that is taken out of the scene is no longer moved; the others keep their numbers.
  scene->animation = with_lights_kept(*scene->animation, {false});
  scene->lights.clear();
  EXPECT_TRUE(pose_scene(*scene, 1).has_value());
}

TEST(Animation, at_its_first_key_is_the_resting_pose_and_going_back_undoes_it) {
  Json file = moving_square({0, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0}});
  Result<Scene> scene = load(file);
  ASSERT_TRUE(scene.has_value());
  const std::vector<Vec3> resting = scene->meshes[0].positions;
  ASSERT_TRUE(pose_scene(*scene, 0.7).has_value());
  EXPECT_GT(length(scene->meshes[0].positions[2] - resting[2]), 0.1f);  // else going back proves nothing
  ASSERT_TRUE(pose_scene(*scene, 0).has_value());
  for (std::size_t i = 0; i < resting.size(); ++i) EXPECT_EQ(length(scene->meshes[0].positions[i] - resting[i]), 0);
}

void expect_refused(const Json& file, const std::string& code, const std::string& object) {
  const std::string fault = fault_of(file);
  EXPECT_NE(fault.find(code), std::string::npos) << code << ": " << fault;
  EXPECT_NE(fault.find(object), std::string::npos) << fault;
}

TEST(Animation, that_is_malformed_is_refused) {
  const Motion good{0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0}};
  EXPECT_EQ(fault_of(moving_square(good)), "");
  const auto changed = [&](auto change) {
    Motion motion = good;
    change(motion);
    return moving_square(motion);
  };
  expect_refused(changed([](Motion& m) { m.times = {1, 1}; }), "NON_INCREASING", "sampler 0");
  expect_refused(changed([](Motion& m) { m.times = {-1, 1}; }), "INPUT_NEGATIVE", "sampler 0");
  expect_refused(changed([](Motion& m) { m.times = {0, 1, 2}; }), "OUTPUT_ACCESSOR_INVALID_COUNT", "sampler 0");
  expect_refused(changed([](Motion& m) { m.interpolation = "CUBICSPLINE"; }), "INVALID_COUNT", "sampler 0");
  expect_refused(changed([](Motion& m) { m.interpolation = "BOUNCY"; }), "VALUE_NOT_IN_LIST", "sampler 0");
  expect_refused(changed([](Motion& m) { m.times[1] = std::numeric_limits<float>::infinity(); }), "INVALID_FLOAT",
                 "accessor");
  expect_refused(changed([](Motion& m) { m.values[3] = std::numeric_limits<float>::quiet_NaN(); }), "INVALID_FLOAT",
                 "accessor");
  expect_refused(changed([](Motion& m) { m.node = 7; }), "UNRESOLVED_REFERENCE", "channel 0");
  expect_refused(moving_square({0, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 0}}), "ROTATION_NON_UNIT",
                 "key 1");
  expect_refused(moving_square({0, "translation", "CUBICSPLINE", {0}, {0, 0, 0, 0, 0, 0, 0, 0, 0}}), "TOO_FEW",
                 "sampler 0");
  Json twice = moving_square(good);
  add_motion(twice, good);
  expect_refused(twice, "ANIMATION_DUPLICATE_TARGETS", "channel 1");
  Json matrix = moving_square(good);
  matrix["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  expect_refused(matrix, "ANIMATION_CHANNEL_TARGET_NODE_MATRIX", "channel 0");
  Json shape = moving_square(good);
  shape["animations"][0]["channels"][0]["target"]["path"] = "rotation";
  expect_refused(shape, "OUTPUT_ACCESSOR_INVALID_FORMAT", "channel 0");
}

TEST(Animation, that_leaves_the_world_fails_when_it_does) {
  Result<Scene> scene = load(moving_square({0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1e30f, 0, 0}}));
  ASSERT_TRUE(scene.has_value());
  EXPECT_TRUE(pose_scene(*scene, 0).has_value());
  const Status posed = pose_scene(*scene, 1);
  ASSERT_FALSE(posed.has_value());
  EXPECT_NE(posed.error().message.find("made.gltf: at 1.0"), std::string::npos) << posed.error().message;
}

TEST(Animation, of_another_kind_is_left_out_with_one_sentence) {
  Json file = moving_square({0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0}});
  Json& channels = file["animations"][0]["channels"];
  for (const char* path : {"weights", "pointer"}) {
    channels.push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}});
  }
  file["animations"].push_back(file["animations"][0]);
  Result<Scene> scene = load(file);
  ASSERT_TRUE(scene.has_value()) << scene.error().message;
  EXPECT_EQ(scene->warnings.size(), 2u);  // one for the channels, one for the second animation
  ASSERT_NE(scene->animation, nullptr);
}

TEST(Animation, of_nothing_that_is_seen_is_none) {
  Json file = moving_square({1, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0}});
  file["nodes"].push_back(Json::object());
  file["scenes"][0]["nodes"].push_back(1);
  EXPECT_EQ(load(file)->animation, nullptr);
}

TEST(Animation, charges_every_channel_for_its_keys) {
  std::vector<float> times, values;
  for (int i = 0; i < 400; ++i) times.push_back(float(i)), values.insert(values.end(), {0, 0, 0});
  const Json file = moving_square({0, "translation", "LINEAR", times, values});
  LoadLimits limits;
  limits.vertices = 1000;
  EXPECT_EQ(fault_of(file, limits), "");
  limits.vertices = 500;
  EXPECT_NE(fault_of(file, limits).find("VALUE_NOT_IN_RANGE"), std::string::npos);
}

}  // namespace
}  // namespace luciole::test
