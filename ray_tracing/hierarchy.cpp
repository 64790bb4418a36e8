// SPDX-License-Identifier: Apache-2.0
#include "ray_tracing/hierarchy.h"

#include <algorithm>
#include <mutex>
#include <string>

#include "base/thread_sanitizer.h"
#include "ray_tracing/check_indices.h"
#include "ray_tracing/embree_version.h"
#include "scene/surface.h"

namespace luciole {
namespace {

constexpr unsigned kWidth = 4;       // children of a node
constexpr unsigned kMostInLeaf = 4;  // triangles: one costs a ray about as much as a node
constexpr unsigned kMostDepth = 32;  // good hierarchies need half of it; Embree holds itself to it
static_assert(kMostDepth * (kWidth - 1) <= kTraceStack);
constexpr std::size_t kMostTriangles = kLeafFirstMask;

// What Embree's builder makes, before it is flattened.
struct BuiltNode {
  std::uint32_t count = 0;  // children or triangles
  bool is_leaf = false;
};
struct BuiltInner : BuiltNode {
  RTCBounds bounds[kWidth];
  const BuiltNode* child[kWidth];
};
struct BuiltLeaf : BuiltNode {
  std::uint32_t mesh[kMostInLeaf], triangle[kMostInLeaf];
};

void* create_inner(RTCThreadLocalAllocator allocator, unsigned children, void* /*user*/) {
  auto* node = new (rtcThreadLocalAlloc(allocator, sizeof(BuiltInner), alignof(BuiltInner))) BuiltInner;
  node->count = children;
  return node;
}
void set_children(void* node, void** children, unsigned count, void* /*user*/) {
  for (unsigned i = 0; i < count; ++i) {
    static_cast<BuiltInner*>(node)->child[i] = static_cast<const BuiltNode*>(children[i]);
  }
}
void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void* /*user*/) {
  for (unsigned i = 0; i < count; ++i) static_cast<BuiltInner*>(node)->bounds[i] = *bounds[i];
}
void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void* /*user*/) {
  auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuiltLeaf), alignof(BuiltLeaf))) BuiltLeaf;
  leaf->is_leaf = true, leaf->count = static_cast<std::uint32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    leaf->mesh[i] = primitives[i].geomID, leaf->triangle[i] = primitives[i].primID;
  }
  return leaf;
}

struct Corners {
  Vec3 a, b, c;
};

Corners corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const std::uint32_t* index = &mesh.indices[std::size_t(triangle) * 3];
  return {mesh.positions[index[0]], mesh.positions[index[1]], mesh.positions[index[2]]};
}

// As Embree's builder takes them.
std::vector<RTCBuildPrimitive> boxes_of(const Scene& scene) {
  std::vector<RTCBuildPrimitive> boxes;
  boxes.reserve(scene.triangle_count());
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    const auto triangles = static_cast<std::uint32_t>(scene.meshes[mesh].indices.size() / 3);
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle) {
      const Corners t = corners_of(scene.meshes[mesh], triangle);
      const Vec3 area = cross(t.b - t.a, t.c - t.a);
      if (area.x == 0 && area.y == 0 && area.z == 0) continue;  // its square may be too small for a float
      const Vec3 low = min(min(t.a, t.b), t.c), high = max(max(t.a, t.b), t.c);
      boxes.push_back({low.x, low.y, low.z, mesh, high.x, high.y, high.z, triangle});
    }
  }
  return boxes;
}

// Embree's device and the nodes that it built, until they are flattened.
class Builder {
 public:
  Builder() = default;
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;
  ~Builder() {
    if (hierarchy_ != nullptr) rtcReleaseBVH(hierarchy_);
    if (device_ != nullptr) rtcReleaseDevice(device_);
  }

  // The boxes come back in another order. None: error() says why.
  const BuiltNode* build(std::vector<RTCBuildPrimitive>& boxes);
  Error error() {
    const std::lock_guard lock(guard_);
    if (code_ == RTC_ERROR_OUT_OF_MEMORY) {
      return {ErrorKind::out_of_memory, "the scene's hierarchy for devices does not fit into memory"};
    }
    return {ErrorKind::failed, "Embree cannot build this scene's hierarchy: " + message_};
  }

 private:
  static void on_error(void* self, RTCError code, const char* text) {
    Builder& builder = *static_cast<Builder*>(self);
    const std::lock_guard lock(builder.guard_);
    builder.code_ = code;
    builder.message_ = text == nullptr ? "unknown error" : text;
  }

  std::mutex guard_;  // of what any thread may write
  RTCError code_ = RTC_ERROR_NONE;
  std::string message_ = "no device";
  RTCDevice device_ = nullptr;
  RTCBVH hierarchy_ = nullptr;
};

const BuiltNode* Builder::build(std::vector<RTCBuildPrimitive>& boxes) {
#if defined(LUCIOLE_THREAD_SANITIZER)
  device_ = rtcNewDevice("threads=1");
#else
  device_ = rtcNewDevice(nullptr);
#endif
  if (device_ == nullptr) return nullptr;
  rtcSetDeviceErrorFunction(device_, on_error, this);
  hierarchy_ = rtcNewBVH(device_);
  if (hierarchy_ == nullptr) return nullptr;
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;  // by the surface area heuristic
  arguments.maxBranchingFactor = kWidth;
  arguments.maxDepth = kMostDepth;
  arguments.maxLeafSize = kMostInLeaf;
  arguments.bvh = hierarchy_;
  arguments.primitives = boxes.data(), arguments.primitiveCount = arguments.primitiveArrayCapacity = boxes.size();
  arguments.createNode = create_inner, arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds, arguments.createLeaf = create_leaf;
  return static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
}

// Writes nodes and triangles in the order in which a ray goes down that meets everything.
class Flattener {
 public:
  explicit Flattener(const Scene& scene) : scene_(scene) {
    for (const Mesh& mesh : scene.meshes) has_holes_.push_back(can_have_holes(scene, mesh) ? 1 : 0);
  }

  Hierarchy flattened(const BuiltNode& root) {
    const Placed placed = place(root);
    made_.root = placed.reference, made_.stack = placed.stack;
    return std::move(made_);
  }

 private:
  struct Placed {
    word_ reference;
    std::uint32_t stack;
  };

  Placed place(const BuiltNode& node) {  // NOLINT(misc-no-recursion): as deep as the hierarchy
    return node.is_leaf ? place_leaf(static_cast<const BuiltLeaf&>(node))
                        : place_inner(static_cast<const BuiltInner&>(node));
  }

  Placed place_inner(const BuiltInner& inner) {  // NOLINT(misc-no-recursion)
    const std::size_t number = made_.nodes.size();
    made_.nodes.emplace_back();
    HierarchyNode node{};
    std::uint32_t below = 0;
    for (unsigned i = 0; i < kWidth; ++i) {
      node.child[i] = kNothing;
      if (i >= inner.count) continue;
      const RTCBounds& box = inner.bounds[i];
      node.low_x[i] = box.lower_x, node.low_y[i] = box.lower_y, node.low_z[i] = box.lower_z;
      node.high_x[i] = box.upper_x, node.high_y[i] = box.upper_y, node.high_z[i] = box.upper_z;
      const Placed child = place(*inner.child[i]);
      node.child[i] = child.reference;
      below = std::max(below, child.stack);
    }
    made_.nodes[number] = node;
    // While one child is visited all the others may wait.
    return {static_cast<word_>(number), inner.count - 1 + below};
  }

  Placed place_leaf(const BuiltLeaf& leaf) {
    const auto first = static_cast<word_>(made_.triangles.size());
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      const Corners t = corners_of(scene_.meshes[leaf.mesh[i]], leaf.triangle[i]);
      made_.triangles.push_back({{t.a.x, t.a.y, t.a.z},
                                 {t.b.x, t.b.y, t.b.z},
                                 {t.c.x, t.c.y, t.c.z},
                                 leaf.mesh[i],
                                 leaf.triangle[i],
                                 has_holes_[leaf.mesh[i]]});
    }
    return {kLeaf | (leaf.count - 1) << kLeafCountShift | first, 0};
  }

  const Scene& scene_;
  std::vector<word_> has_holes_;  // per mesh
  Hierarchy made_;
};

}  // namespace

Result<Hierarchy> build_hierarchy(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    if (Status valid = check_indices(mesh); !valid) return valid.error();
  }
  std::vector<RTCBuildPrimitive> boxes = boxes_of(scene);
  if (boxes.empty()) return Hierarchy{};
  if (boxes.size() > kMostTriangles) {
    return Error{ErrorKind::failed,
                 "the scene has more triangles than a device's ray caster can number: " + std::to_string(boxes.size())};
  }
  Builder builder;
  const BuiltNode* root = builder.build(boxes);
  if (root == nullptr) return builder.error();
  Hierarchy made = Flattener(scene).flattened(*root);
  if (made.stack > kTraceStack) {
    return Error{ErrorKind::failed, "the scene's hierarchy is too deep for a device's ray caster"};
  }
  return made;
}

}  // namespace luciole
