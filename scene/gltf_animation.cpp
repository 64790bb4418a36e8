// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_animation.h"

#include <cmath>
#include <string>
#include <utility>

#include "scene/file_fault.h"
#include "scene/gltf_accessor.h"

namespace luciole::gltf {
namespace {

// What a channel moves has so many numbers per key; 0: as many as there are morph targets.
std::uint32_t components_of(const std::string& path) {
  if (path == "rotation") return 4;
  return path == "weights" || path == "pointer" ? 0 : 3;
}

std::string path_of(const JsonObject& target) {
  const std::string path = target.text("path");
  for (const char* known : {"translation", "rotation", "scale", "weights", "pointer"}) {
    if (path == known) return path;
  }
  fail("VALUE_NOT_IN_LIST", target.label(), "property \"path\" has an unknown value");
}

Interpolation interpolation_of(const JsonObject& sampler) {
  const std::string name = sampler.text("interpolation", "LINEAR");
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
  fail("VALUE_NOT_IN_LIST", sampler.label(), "property \"interpolation\" has an unknown value");
}

JsonObject target_of(const JsonObject& channel) {
  const std::optional<JsonObject> target = channel.object("target");
  if (!target) fail("UNDEFINED_PROPERTY", channel.label(), "property \"target\" is missing");
  return *target;
}

void check_sampler(const Document& document, const JsonObject& sampler) {
  const AccessorShape times = accessor_shape(document, sampler.required_reference("input", document.count(kAccessors)));
  if (times.components != 1 || times.component_type != ComponentType::float32) {
    fail("ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", sampler.label(), times.label + " does not hold times");
  }
  sampler.required_reference("output", document.count(kAccessors));
  interpolation_of(sampler);
}

void check_channel(const Document& document, const JsonObject& channel, const std::vector<JsonObject>& samplers) {
  const JsonObject& sampler = samplers[channel.required_reference("sampler", samplers.size())];
  const JsonObject target = target_of(channel);
  target.reference("node", document.count(kNodes));
  const std::uint32_t components = components_of(path_of(target));
  const AccessorShape output =
      accessor_shape(document, sampler.required_reference("output", document.count(kAccessors)));
  if (components != 0 && output.components != components) {
    fail("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT", channel.label(),
         output.label + " does not fit " + path_of(target));
  }
}

void check_times(const std::vector<float>& times, const JsonObject& sampler) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < 0) fail("ACCESSOR_ANIMATION_INPUT_NEGATIVE", sampler.label(), "has a key before time 0");
    if (i > 0 && !(times[i] > times[i - 1])) {
      fail("ACCESSOR_ANIMATION_INPUT_NON_INCREASING", sampler.label(),
           "key " + std::to_string(i) + " is not after the one before it");
    }
  }
}

void check_rotations(const Track& track, const JsonObject& sampler) {
  const bool spline = track.interpolation == Interpolation::cubic_spline;
  for (std::size_t key = 0; key < track.times.size(); ++key) {
    const float* q = track.values.data() + (spline ? 12 * key + 4 : 4 * key);
    const float norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(norm > 1e-6f) || !std::isfinite(norm)) {
      fail("ROTATION_NON_UNIT", sampler.label(), "the rotation of key " + std::to_string(key) + " has no direction");
    }
  }
}

}  // namespace

void check_animations(Document& document) {
  for (std::size_t i = 0; i < document.count(kAnimations); ++i) {
    const JsonObject animation = document.element(kAnimations, i);
    const std::vector<JsonObject> samplers = animation.objects("samplers", "sampler");
    for (const JsonObject& sampler : samplers) check_sampler(document, sampler);
    for (const JsonObject& channel : animation.objects("channels", "channel")) {
      check_channel(document, channel, samplers);
    }
  }
}

MotionReader::MotionReader(Document& document) : document_(document) {
  check_animations(document);
  if (document.count(kAnimations) == 0) return;
  const JsonObject first = document.element(kAnimations, 0);
  animation_.name = first.text("name");
  const std::vector<JsonObject> samplers = first.objects("samplers", "sampler");
  for (const JsonObject& channel : first.objects("channels", "channel")) read_channel(channel, samplers);
  if (document.count(kAnimations) > 1) {
    document.warn("animations", "Only the first of " + std::to_string(document.count(kAnimations)) +
                                    " animations is played: " + first.label() + ".");
  }
}

Track MotionReader::read_track(const JsonObject& sampler, std::size_t components) {
  Track track;
  track.interpolation = interpolation_of(sampler);
  const std::size_t input = sampler.required_reference("input", document_.count(kAccessors));
  const std::size_t output = sampler.required_reference("output", document_.count(kAccessors));
  const AccessorShape times = accessor_shape(document_, input), values = accessor_shape(document_, output);
  const bool spline = track.interpolation == Interpolation::cubic_spline;
  if (times.count < (spline ? 2u : 1u)) {
    fail("ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS", sampler.label(), times.label + " has too few keys");
  }
  if (values.count != times.count * (spline ? 3 : 1)) {
    fail("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", sampler.label(), values.label + " does not fit its times");
  }
  // Each channel keeps numbers of its own: many channels of one accessor must not fill the memory.
  document_.charge_vertices(times.count + values.count, sampler.label());
  track.times = read_floats(document_, input);
  track.values = read_floats(document_, output);
  check_times(track.times, sampler);
  if (components == 4) check_rotations(track, sampler);
  return track;
}

void MotionReader::read_channel(const JsonObject& channel, const std::vector<JsonObject>& samplers) {
  const JsonObject target = target_of(channel);
  const std::string path = path_of(target);
  const std::optional<std::size_t> node = target.reference("node", document_.count(kNodes));
  const std::uint32_t components = components_of(path);
  if (components == 0 || !node) {
    return document_.warn("channels", "Animations of morph weights and of properties by pointer are ignored.");
  }
  if (document_.element(kNodes, *node).has("matrix")) {
    fail("ANIMATION_CHANNEL_TARGET_NODE_MATRIX", channel.label(), "moves a node that has a matrix");
  }
  MovingNode& moving = tracks_[*node];
  Track& track = path == "rotation"      ? moving.rotation_track
                 : path == "translation" ? moving.translation_track
                                         : moving.scale_track;
  if (!track.rests()) fail("ANIMATION_DUPLICATE_TARGETS", channel.label(), "moves what another channel moves");
  track = read_track(samplers[channel.required_reference("sampler", samplers.size())], components);
}

std::optional<std::uint32_t> MotionReader::visit(const NodeVisit& visited) {
  const auto tracks = tracks_.find(visited.node);
  const auto parent = visited.parent ? moving_.find(*visited.parent) : moving_.end();
  if (tracks == tracks_.end() && parent == moving_.end()) return std::nullopt;
  MovingNode node;
  if (tracks != tracks_.end()) node = std::move(tracks->second);
  if (parent != moving_.end()) node.parent = static_cast<std::int32_t>(parent->second);
  node.world_from_parent = visited.world_from_parent;
  node.parent_from_node = visited.parent_from_node;
  const JsonObject json = document_.element(kNodes, visited.node);
  const auto t = json.numbers<3>("translation", {0, 0, 0});
  const auto r = json.numbers<4>("rotation", {0, 0, 0, 1});
  const auto s = json.numbers<3>("scale", {1, 1, 1});
  node.translation = {t[0], t[1], t[2]}, node.rotation = {r[0], r[1], r[2], r[3]}, node.scale = {s[0], s[1], s[2]};
  const auto index = static_cast<std::uint32_t>(animation_.nodes.size());
  animation_.nodes.push_back(std::move(node));
  return moving_[visited.node] = index;
}

std::shared_ptr<const Animation> MotionReader::take() {
  if (animation_.meshes.empty() && animation_.lights.empty() && animation_.cameras.empty()) return nullptr;
  return std::make_shared<const Animation>(std::move(animation_));
}

}  // namespace luciole::gltf
