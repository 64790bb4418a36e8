// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_animation_writer.h"

#include <algorithm>

namespace luciole::gltf {
namespace {

Json json_of(Vec3 v) { return Json::array({v.x, v.y, v.z}); }
Json json_of(Vec4 v) { return Json::array({v.x, v.y, v.z, v.w}); }

Json matrix_json(const Affine& map) {
  Json list = Json::array();
  for (const Vec3 column : {map.x, map.y, map.z, map.translation}) {
    for (const float value : {column.x, column.y, column.z}) list.push_back(value);
    list.push_back(list.size() == 15 ? 1.0f : 0.0f);
  }
  return list;
}

const char* name_of(Interpolation interpolation) {
  if (interpolation == Interpolation::step) return "STEP";
  return interpolation == Interpolation::linear ? "LINEAR" : "CUBICSPLINE";
}

class AnimationWriter {
 public:
  AnimationWriter(const Animation& animation, BufferWriter& buffer, Json& document)
      : buffer_(buffer), document_(document) {
    moves_["name"] = animation.name.empty() ? "motion" : animation.name;
    for (const MovingNode& node : animation.nodes) add(node, animation.metres_per_unit);
    if (moves_.contains("channels")) document_["animations"] = Json::array({std::move(moves_)});
  }

  // A node of its own below a moving one.
  void hang(std::uint32_t moving, Json node) { add_child(nodes_[moving], std::move(node)); }

 private:
  void add(const MovingNode& moving, float metres_per_unit) {
    Json node = Json::object();
    if (moving.translation_track.rests() && moving.rotation_track.rests() && moving.scale_track.rests()) {
      node["matrix"] = matrix_json(moving.parent_from_node);
    } else {
      node["translation"] = json_of(moving.translation);
      node["rotation"] = json_of(moving.rotation);
      node["scale"] = json_of(moving.scale);
    }
    const std::size_t parent = moving.parent < 0 ? add_root(moving.world_from_parent, metres_per_unit)
                                                 : nodes_[static_cast<std::size_t>(moving.parent)];
    nodes_.push_back(add_child(parent, std::move(node)));
    add_channel("translation", moving.translation_track);
    add_channel("rotation", moving.rotation_track);
    add_channel("scale", moving.scale_track);
  }

  std::size_t add_root(const Affine& map, float metres_per_unit) {
    const Affine scaled{map.x * metres_per_unit, map.y * metres_per_unit, map.z * metres_per_unit,
                        map.translation * metres_per_unit};
    document_["nodes"].push_back({{"matrix", matrix_json(scaled)}});
    const std::size_t index = document_["nodes"].size() - 1;
    document_["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  std::size_t add_child(std::size_t parent, Json node) {
    document_["nodes"].push_back(std::move(node));
    const std::size_t index = document_["nodes"].size() - 1;
    document_["nodes"][parent]["children"].push_back(index);
    return index;
  }

  // Of the node that was added last.
  void add_channel(const char* path, const Track& track) {
    if (track.rests()) return;
    const bool turns = std::string(path) == "rotation";
    const std::size_t times = buffer_.add_track(track.times, 1),
                      values = buffer_.add_track(track.values, turns ? 4 : 3);
    moves_["samplers"].push_back(
        {{"input", times}, {"output", values}, {"interpolation", name_of(track.interpolation)}});
    moves_["channels"].push_back(
        {{"sampler", moves_["samplers"].size() - 1}, {"target", {{"node", nodes_.back()}, {"path", path}}}});
  }

  BufferWriter& buffer_;
  Json& document_;
  Json moves_ = Json::object();
  std::vector<std::size_t> nodes_;  // of the document, per moving node
};

}  // namespace

const MovingMesh* moving_mesh(const Scene& scene, std::size_t mesh) {
  if (!scene.animation) return nullptr;
  for (const MovingMesh& moving : scene.animation->meshes) {
    if (moving.mesh == mesh) return &moving;
  }
  return nullptr;
}

bool is_moving_light(const Scene& scene, std::size_t light) {
  return scene.animation && std::any_of(scene.animation->lights.begin(), scene.animation->lights.end(),
                                        [light](const MovingLight& moving) { return moving.light == light; });
}

bool is_moving_camera(const Scene& scene, std::size_t camera) {
  return scene.animation && std::any_of(scene.animation->cameras.begin(), scene.animation->cameras.end(),
                                        [camera](const MovingCamera& moving) { return moving.camera == camera; });
}

void add_animation(const Scene& scene, const std::vector<std::size_t>& meshes, BufferWriter& buffer, Json& document) {
  if (!scene.animation) return;
  const Animation& animation = *scene.animation;
  AnimationWriter writer(animation, buffer, document);
  for (const MovingMesh& moving : animation.meshes) {
    if (scene.meshes[moving.mesh].indices.empty()) continue;
    writer.hang(moving.node, {{"name", scene.meshes[moving.mesh].name},
                              {"mesh", meshes[moving.mesh]},
                              {"matrix", matrix_json(moving.node_from_mesh)}});
  }
  for (const MovingLight& moving : animation.lights) {
    writer.hang(moving.node, {{"name", scene.lights[moving.light].name},
                              {"extensions", {{"KHR_lights_punctual", {{"light", moving.light}}}}}});
  }
  for (const MovingCamera& moving : animation.cameras) {
    writer.hang(moving.node, {{"name", scene.cameras[moving.camera].name}, {"camera", moving.camera}});
  }
}

}  // namespace luciole::gltf
