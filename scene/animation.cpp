// SPDX-License-Identifier: Apache-2.0
#include "scene/animation.h"

#include <algorithm>
#include <cmath>

#include "scene/file_fault.h"
#include "scene/gltf_lights_cameras.h"
#include "scene/gltf_nodes.h"
#include "scene/mesh_finish.h"

namespace luciole {
namespace {

constexpr float kShortest = 1e-6f;  // of a quaternion that still says a direction

float length_of(const float* value, std::size_t count) {
  float sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += value[i] * value[i];
  return std::sqrt(sum);
}

void normalise(float* rotation, const float* otherwise) {
  const float size = length_of(rotation, 4);
  if (size > kShortest && std::isfinite(size)) {
    for (std::size_t i = 0; i < 4; ++i) rotation[i] /= size;
  } else {
    const float known = length_of(otherwise, 4);
    for (std::size_t i = 0; i < 4; ++i) rotation[i] = known > 0 ? otherwise[i] / known : (i == 3 ? 1.0f : 0.0f);
  }
}

// Along the shorter great circle between two rotations, at constant speed (glTF 2.0, appendix C.4). Both are unit.
void turn(const float* from, const float* to, float t, float* rotation) {
  float cosine = 0;
  for (std::size_t i = 0; i < 4; ++i) cosine += from[i] * to[i];
  const float side = cosine < 0 ? -1.0f : 1.0f, angle = std::acos(std::min(std::abs(cosine), 1.0f));
  // Where sin(angle) is too small to divide by, the chord is the circle.
  const bool near = angle < 1e-3f;
  const float first = near ? 1 - t : std::sin((1 - t) * angle) / std::sin(angle);
  const float second = side * (near ? t : std::sin(t * angle) / std::sin(angle));
  for (std::size_t i = 0; i < 4; ++i) rotation[i] = first * from[i] + second * to[i];
}

// glTF 2.0, appendix C.5; tangents are per second.
void on_spline(const float* key, const float* next, float t, float duration, std::size_t count, float* value) {
  const float t2 = t * t, t3 = t2 * t;
  for (std::size_t i = 0; i < count; ++i) {
    const float from = key[count + i], leaving = key[2 * count + i], arriving = next[i], to = next[count + i];
    value[i] = (2 * t3 - 3 * t2 + 1) * from + duration * (t3 - 2 * t2 + t) * leaving + (-2 * t3 + 3 * t2) * to +
               duration * (t3 - t2) * arriving;
  }
}

template <class Vector>
Vec3 vec3_of(const Vector& v) {
  return {v[0], v[1], v[2]};
}

Affine pose_of(const MovingNode& node, double time) {
  if (node.translation_track.rests() && node.rotation_track.rests() && node.scale_track.rests()) {
    return node.parent_from_node;
  }
  float translation[3] = {node.translation.x, node.translation.y, node.translation.z};
  float rotation[4] = {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
  float scale[3] = {node.scale.x, node.scale.y, node.scale.z};
  evaluate_track(node.translation_track, time, 3, translation);
  evaluate_track(node.rotation_track, time, 4, rotation);
  evaluate_track(node.scale_track, time, 3, scale);
  return gltf::affine_from_parts(vec3_of(translation), {rotation[0], rotation[1], rotation[2], rotation[3]},
                                 vec3_of(scale), "an animated node");
}

Affine scaled(const Affine& map, float factor) {
  return {map.x * factor, map.y * factor, map.z * factor, map.translation * factor};
}

void pose_or_throw(const Animation& animation, double time, Scene& scene) {
  std::vector<Affine> world_from_node;
  world_from_node.reserve(animation.nodes.size());
  for (const MovingNode& node : animation.nodes) {
    const Affine& above =
        node.parent < 0 ? node.world_from_parent : world_from_node[static_cast<std::size_t>(node.parent)];
    world_from_node.push_back(above * pose_of(node, time));
  }
  for (Affine& map : world_from_node) map = scaled(map, animation.metres_per_unit);
  for (const MovingMesh& moving : animation.meshes) {
    Mesh posed = moving.at_rest;
    transform_mesh(posed, world_from_node[moving.node] * moving.node_from_mesh, "mesh \"" + posed.name + "\"");
    scene.meshes[moving.mesh] = std::move(posed);
  }
  for (const MovingLight& moving : animation.lights) {
    gltf::place_light(scene.lights[moving.light], world_from_node[moving.node], "an animated light");
  }
  for (const MovingCamera& moving : animation.cameras) {
    gltf::place_camera(scene.cameras[moving.camera], world_from_node[moving.node], "an animated camera");
  }
}

}  // namespace

void evaluate_track(const Track& track, double time, std::size_t count, float* value) {
  if (track.rests()) return;
  const std::size_t keys = track.times.size(),
                    stride = track.interpolation == Interpolation::cubic_spline ? 3 * count : count;
  const std::size_t middle = stride == count ? 0 : count;  // where a key's value stands among its numbers
  const auto key = [&](std::size_t i) { return track.values.data() + i * stride; };
  const auto behind = std::upper_bound(track.times.begin(), track.times.end(), time,
                                       [](double at, float key_time) { return at < double(key_time); });
  const auto after = static_cast<std::size_t>(behind - track.times.begin());
  const std::size_t before = after == 0 ? 0 : after - 1;
  const bool outside = after == 0 || after == keys;
  if (outside || track.interpolation == Interpolation::step) {
    std::copy_n(key(before) + middle, count, value);
  } else {
    const double duration = double(track.times[after]) - double(track.times[before]);
    const auto t = static_cast<float>((time - double(track.times[before])) / duration);
    if (track.interpolation == Interpolation::cubic_spline) {
      on_spline(key(before), key(after), t, static_cast<float>(duration), count, value);
    } else if (count == 4) {
      float from[4], to[4];
      std::copy_n(key(before), 4, from), std::copy_n(key(after), 4, to);
      normalise(from, from), normalise(to, to);
      turn(from, to, t, value);
    } else {
      for (std::size_t i = 0; i < count; ++i) value[i] = key(before)[i] * (1 - t) + key(after)[i] * t;
    }
  }
  if (count == 4) normalise(value, key(before) + middle);
}

float Animation::duration() const {
  float last = 0;
  for (const MovingNode& node : nodes) {
    for (const Track* track : {&node.translation_track, &node.rotation_track, &node.scale_track}) {
      if (!track->rests()) last = std::max(last, track->times.back());
    }
  }
  return last;
}

Status pose_scene(Scene& scene, double time) try {
  if (scene.animation) pose_or_throw(*scene.animation, time, scene);
  return Done{};
} catch (const FileFault& fault) {
  return Error{ErrorKind::bad_scene,
               scene.name + ": at " + std::to_string(time) + " s of its animation: " + fault.what()};
}

std::shared_ptr<const Animation> with_lights_kept(const Animation& animation, const std::vector<bool>& kept) {
  auto changed = std::make_shared<Animation>(animation);
  std::erase_if(changed->lights, [&kept](const MovingLight& moving) { return !kept[moving.light]; });
  for (MovingLight& moving : changed->lights) {
    moving.light = static_cast<std::uint32_t>(std::count(kept.begin(), kept.begin() + moving.light, true));
  }
  return changed;
}

}  // namespace luciole
