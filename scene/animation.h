// SPDX-License-Identifier: Apache-2.0
// Door: what of a scene moves, and the scene at a time. Rigid motion and scale of nodes, as glTF 2.0 has them.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/affine.h"
#include "base/result.h"
#include "scene/scene.h"

namespace luciole {

enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

// A property over time: so many numbers per key, for cubic splines three times as many (in-tangent, value,
// out-tangent; glTF 2.0, appendix C). No keys: it rests.
struct Track {
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;   // [s], strictly ascending, >= 0
  std::vector<float> values;  // of all keys, one after another
  bool rests() const { return times.empty(); }
};

// A node that moves, or whose parent does. Parents come first.
struct MovingNode {
  std::int32_t parent = -1;    // in Animation::nodes; -1: world_from_parent does not move
  Affine world_from_parent{};  // where there is no parent
  Affine parent_from_node{};   // where all three tracks rest; else the parts that rest:
  Vec3 translation{0, 0, 0};
  Vec4 rotation{0, 0, 0, 1};  // x, y, z, w
  Vec3 scale{1, 1, 1};
  Track translation_track, rotation_track, scale_track;  // 3, 4 and 3 numbers
};

// A mesh, light or camera of the scene that goes with a node.
struct MovingMesh {
  std::uint32_t mesh = 0, node = 0;  // in Scene::meshes, Animation::nodes
  Affine node_from_mesh{};
  Mesh at_rest;  // in its own space
};
struct MovingLight {
  std::uint32_t light = 0, node = 0;
};
struct MovingCamera {
  std::uint32_t camera = 0, node = 0;
};

struct Animation {
  std::string name;
  float metres_per_unit = 1;  // of all that the nodes say
  std::vector<MovingNode> nodes;
  std::vector<MovingMesh> meshes;
  std::vector<MovingLight> lights;
  std::vector<MovingCamera> cameras;

  float duration() const;  // the last key of all [s]
};

// Moves meshes, lights and cameras to where they are at a time [s]: before the first key of a track as at it, after the
// last as at that. Does nothing to a scene without animation. Fails where a vertex would leave the range of numbers
// that can be rendered; the scene is then between two poses.
Status pose_scene(Scene& scene, double time);

// A track's value, `count` numbers (3 or 4; four are a rotation and come out as a unit quaternion).
void evaluate_track(const Track& track, double time, std::size_t count, float* value);

// Forgets lights of the scene that are no longer there, as std::erase_if(scene.lights, ...) removed them.
//   kept  per former light, whether it still is there
std::shared_ptr<const Animation> with_lights_kept(const Animation& animation, const std::vector<bool>& kept);

}  // namespace luciole
