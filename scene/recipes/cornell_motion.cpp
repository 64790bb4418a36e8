// SPDX-License-Identifier: Apache-2.0
#include "scene/recipes/cornell_motion.h"

#include <cmath>
#include <memory>

#include "scene/animation.h"
#include "scene/recipes/placement.h"
#include "scene/recipes/scene_kit.h"

namespace luciole::workshop {
namespace {

constexpr float kDuration = 8;  // [s]

void append(std::vector<float>& values, std::initializer_list<float> more) {
  values.insert(values.end(), more.begin(), more.end());
}

// Once round in eight steps, so that every turn between two keys has a shorter way.
MovingNode turning_block() {
  MovingNode node;
  node.translation_track = {Interpolation::linear, {0, kDuration / 2, kDuration}, {}};
  append(node.translation_track.values, {0.33f, 0.3f, 0.36f, -0.35f, 0.3f, 0.5f, 0.33f, 0.3f, 0.36f});
  for (int key = 0; key <= 8; ++key) {
    const float turned = kTwoPi * static_cast<float>(key) / 8, angle = turned + radians(-17);
    node.rotation_track.times.push_back(kDuration * static_cast<float>(key) / 8);
    append(node.rotation_track.values, {0, std::sin(angle / 2), 0, std::cos(angle / 2)});
  }
  return node;
}

// Lights shine along -Z of their node. At rest in the middle and at both ends: a spline without tangents there.
MovingNode swinging_spot(Vec3 at) {
  MovingNode node;
  node.translation = at;
  node.rotation = {-std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};
  node.translation_track.interpolation = Interpolation::cubic_spline;
  for (const auto& [time, x] : {std::pair{0.0f, 0.0f}, {2.0f, 0.6f}, {6.0f, -0.6f}, {kDuration, 0.0f}}) {
    node.translation_track.times.push_back(time);
    append(node.translation_track.values, {0, 0, 0, at.x + x, at.y, at.z, 0, 0, 0});
  }
  return node;
}

MovingNode coming_nearer() {
  MovingNode node;
  node.translation_track = {Interpolation::linear, {0, kDuration}, {0, 1, 3.9f, 0.3f, 1.2f, 2.4f}};
  return node;
}

}  // namespace

void set_in_motion(Scene& scene, std::uint32_t block) {
  auto animation = std::make_shared<Animation>();
  animation->name = "motion";
  animation->nodes = {turning_block(), swinging_spot(scene.lights[0].position), coming_nearer()};
  animation->meshes = {{block, 0, Affine{}, scene.meshes[block]}};
  animation->lights = {{0, 1}};
  animation->cameras = {{static_cast<std::uint32_t>(scene.cameras.size()), 2}};
  scene.cameras.push_back(named_camera("nearer", {{0, 1, 3.9f}, {0, 1, 0}}, 39));
  scene.animation = std::move(animation);
  // The positions of a box two metres wide are numbers that can be rendered, at all times.
  (void)pose_scene(scene, 0);
}

}  // namespace luciole::workshop
