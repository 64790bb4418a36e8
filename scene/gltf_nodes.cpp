// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_nodes.h"

#include <cmath>
#include <optional>
#include <vector>

#include "scene/file_fault.h"

namespace luciole::gltf {
namespace {

constexpr std::size_t kDeepestNode = 1024;

using Children = std::vector<std::vector<std::size_t>>;

Children read_children(const Document& document) {
  Children children(document.count(kNodes));
  for (std::size_t node = 0; node < children.size(); ++node) {
    children[node] = document.element(kNodes, node).references("children", children.size());
  }
  return children;
}

// Depth-first search with an explicit stack; a node met again while it is open closes a loop.
void check_no_loops(const Document& document, const Children& children) {
  enum class State : std::uint8_t { unseen, open, done };
  std::vector<State> state(children.size(), State::unseen);
  struct Step {
    std::size_t node, next_child;
  };
  std::vector<Step> path;
  for (std::size_t start = 0; start < children.size(); ++start) {
    if (state[start] != State::unseen) continue;
    state[start] = State::open;
    path.push_back({start, 0});
    while (!path.empty()) {
      Step& step = path.back();
      if (step.next_child == children[step.node].size()) {
        state[step.node] = State::done;
        path.pop_back();
        continue;
      }
      const std::size_t child = children[step.node][step.next_child++];
      if (state[child] == State::open) {
        fail("NODE_LOOP", document.element(kNodes, child).label(), "is its own ancestor");
      }
      if (state[child] == State::unseen) {
        state[child] = State::open;
        path.push_back({child, 0});
      }
    }
  }
}

// Returns which nodes are somebody's child.
std::vector<bool> check_single_parents(const Document& document, const Children& children) {
  std::vector<bool> has_parent(children.size(), false);
  for (const std::vector<std::size_t>& siblings : children) {
    for (const std::size_t child : siblings) {
      if (has_parent[child]) fail("NODE_PARENT_OVERRIDE", document.element(kNodes, child).label(), "has two parents");
      has_parent[child] = true;
    }
  }
  return has_parent;
}

std::vector<std::size_t> root_nodes(const Document& document, const std::vector<bool>& has_parent) {
  const std::size_t scenes = document.count(kScenes);
  const std::optional<std::size_t> shown = document.root().reference("scene", scenes);
  if (!shown && scenes == 0) return {};
  const JsonObject scene = document.element(kScenes, shown.value_or(0));
  std::vector<std::size_t> roots = scene.references("nodes", has_parent.size());
  std::vector<bool> listed(has_parent.size(), false);
  for (const std::size_t root : roots) {
    const std::string label = document.element(kNodes, root).label();
    if (has_parent[root]) fail("SCENE_NON_ROOT_NODE", scene.label(), label + " is listed but has a parent");
    if (listed[root]) fail("DUPLICATE_ELEMENTS", scene.label(), label + " is listed twice");
    listed[root] = true;
  }
  return roots;
}

Affine affine_from_matrix(const JsonObject& node) {
  const auto m = node.numbers<16>("matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    fail("NODE_MATRIX_NON_TRS", node.label(), "its matrix does not end in the row 0 0 0 1");
  }
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

Affine parent_from_node(const JsonObject& node) {
  if (node.has("matrix")) {
    if (node.has("translation") || node.has("rotation") || node.has("scale")) {
      fail("NODE_MATRIX_TRS", node.label(), "has a matrix and a translation, rotation or scale");
    }
    return affine_from_matrix(node);
  }
  const auto t = node.numbers<3>("translation", {0, 0, 0});
  const auto r = node.numbers<4>("rotation", {0, 0, 0, 1});
  const auto s = node.numbers<3>("scale", {1, 1, 1});
  return affine_from_parts({t[0], t[1], t[2]}, {r[0], r[1], r[2], r[3]}, {s[0], s[1], s[2]}, node.label());
}

}  // namespace

Affine affine_from_parts(Vec3 translation, Vec4 rotation, Vec3 scale, const std::string& object) {
  const float norm =
      std::sqrt(rotation.x * rotation.x + rotation.y * rotation.y + rotation.z * rotation.z + rotation.w * rotation.w);
  if (!(norm > 1e-6f) || !std::isfinite(norm)) fail("ROTATION_NON_UNIT", object, "its rotation has no direction");
  const float x = rotation.x / norm, y = rotation.y / norm, z = rotation.z / norm, w = rotation.w / norm;
  Affine result;
  result.x = Vec3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)) * scale.x;
  result.y = Vec3(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)) * scale.y;
  result.z = Vec3(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)) * scale.z;
  result.translation = translation;
  return result;
}

void for_each_node(const Document& document, const std::function<void(const NodeVisit&)>& visit) {
  const Children children = read_children(document);
  check_no_loops(document, children);
  const std::vector<bool> has_parent = check_single_parents(document, children);
  struct Pending {
    std::size_t node, depth;
    std::optional<std::size_t> parent;
    Affine world_from_parent;
  };
  std::vector<Pending> stack;
  const std::vector<std::size_t> roots = root_nodes(document, has_parent);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, 1, std::nullopt, Affine{}});
  while (!stack.empty()) {
    const Pending pending = stack.back();
    stack.pop_back();
    const JsonObject node = document.element(kNodes, pending.node);
    if (pending.depth > kDeepestNode) {
      fail("VALUE_NOT_IN_RANGE", node.label(), "lies deeper than " + std::to_string(kDeepestNode) + " levels");
    }
    const Affine local = parent_from_node(node), world_from_node = pending.world_from_parent * local;
    visit({pending.node, pending.parent, pending.world_from_parent, local, world_from_node});
    const std::vector<std::size_t>& siblings = children[pending.node];
    for (auto child = siblings.rbegin(); child != siblings.rend(); ++child) {
      stack.push_back({*child, pending.depth + 1, pending.node, world_from_node});
    }
  }
}

}  // namespace luciole::gltf
