// SPDX-License-Identifier: Apache-2.0
// Animations of a glTF document: which nodes move, and their tracks.
#pragma once
#include <map>
#include <optional>

#include "scene/animation.h"
#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"

namespace luciole::gltf {

// Collects what moves while the nodes are walked. The first animation counts; that there are others, and channels that
// nothing here follows (weights, pointers), is said once each. Refused: times that do not ascend or are negative,
// tracks of the wrong length, rotations without direction, two channels for one property, a node with a matrix.
class MotionReader {
 public:
  explicit MotionReader(Document& document);

  // Of every node, parents first. Returns the moving node's number in the animation, or nothing for one that rests.
  std::optional<std::uint32_t> visit(const NodeVisit& node);

  // Filled by the caller.
  void add(MovingMesh mesh) { animation_.meshes.push_back(std::move(mesh)); }
  void add(MovingLight light) { animation_.lights.push_back(light); }
  void add(MovingCamera camera) { animation_.cameras.push_back(camera); }

  // Nothing where no mesh, light or camera moves.
  std::shared_ptr<const Animation> take();

 private:
  void read_channel(const JsonObject& channel, const std::vector<JsonObject>& samplers);
  Track read_track(const JsonObject& sampler, std::size_t components);

  Document& document_;
  Animation animation_;
  std::map<std::size_t, MovingNode> tracks_;     // by the document's node
  std::map<std::size_t, std::uint32_t> moving_;  // the document's node to the animation's
};

// Of all animations, what can be seen without reading their numbers.
void check_animations(Document& document);

}  // namespace luciole::gltf
