// SPDX-License-Identifier: Apache-2.0
// Hierarchies for devices hold every triangle once, in boxes that contain it, no deeper than kernels can go.
#include "ray_tracing/hierarchy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

// What a walk over all of a hierarchy finds.
struct Walk {
  std::set<std::pair<std::uint32_t, std::uint32_t>> triangles;  // mesh, triangle
  std::size_t visits = 0;                                       // of triangles
  std::size_t outside = 0;                                      // corners that a box above them does not contain
  std::uint32_t most_waiting = 0;
  bool ordered = true;  // children behind their parents, leaves in order
};

struct Box {
  float low[3] = {-1e30f, -1e30f, -1e30f}, high[3] = {1e30f, 1e30f, 1e30f};
  bool contains(const float (&p)[3]) const {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) inside = inside && low[axis] <= p[axis] && p[axis] <= high[axis];
    return inside;
  }
};

Box box_of(const HierarchyNode& n, int lane) {
  return {{n.low_x[lane], n.low_y[lane], n.low_z[lane]}, {n.high_x[lane], n.high_y[lane], n.high_z[lane]}};
}

void visit(const Hierarchy& hierarchy, word_ reference, const Box& box, std::uint32_t waiting, Walk& walk) {
  walk.most_waiting = std::max(walk.most_waiting, waiting);
  if ((reference & kLeaf) != 0) {
    const std::uint32_t first = reference & kLeafFirstMask, count = (reference >> kLeafCountShift & 7u) + 1;
    walk.ordered = walk.ordered && first == walk.visits;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const HierarchyTriangle& t = hierarchy.triangles[i];
      walk.triangles.emplace(t.mesh, t.triangle), ++walk.visits;
      for (const auto* corner : {&t.a, &t.b, &t.c}) walk.outside += !box.contains(*corner);
    }
    return;
  }
  const HierarchyNode& node = hierarchy.nodes[reference];
  std::uint32_t children = 0;
  for (const word_ child : node.child) children += child != kNothing;
  for (int lane = 0; lane < 4; ++lane) {
    if (node.child[lane] == kNothing) continue;
    walk.ordered = walk.ordered && ((node.child[lane] & kLeaf) != 0 || node.child[lane] > reference);
    visit(hierarchy, node.child[lane], box_of(node, lane), waiting + children - 1, walk);
  }
}

Walk walk_of(const Hierarchy& hierarchy) {
  Walk walk;
  if (hierarchy.root != kNothing) visit(hierarchy, hierarchy.root, Box{}, 0, walk);
  return walk;
}

Hierarchy built(const Scene& scene) {
  Result<Hierarchy> made = build_hierarchy(scene);
  EXPECT_TRUE(made.has_value()) << made.error().message;
  return made ? std::move(*made) : Hierarchy{};
}

Mesh triangle_of(Vec3 a, Vec3 b, Vec3 c) {
  Mesh mesh;
  mesh.positions = {a, b, c};
  mesh.indices = {0, 1, 2};
  return mesh;
}

TEST(Hierarchy, holds_every_triangle_once_within_its_boxes) {
  for (const char* address : {"recipe:cornell", "recipe:ring?alpha=0.1", "recipe:gallery?detail=0.05"}) {
    const Result<Scene> scene = make_recipe_from_address(address);
    ASSERT_TRUE(scene.has_value());
    const Hierarchy hierarchy = built(*scene);
    const Walk walk = walk_of(hierarchy);
    EXPECT_EQ(walk.triangles.size(), scene->triangle_count()) << address;
    EXPECT_EQ(walk.visits, walk.triangles.size()) << address;
    EXPECT_EQ(walk.visits, hierarchy.triangles.size()) << address;
    EXPECT_EQ(walk.outside, 0u) << address;
    EXPECT_EQ(walk.most_waiting, hierarchy.stack) << address;
    EXPECT_LE(hierarchy.stack, kTraceStack) << address;
    EXPECT_TRUE(walk.ordered) << address;
    std::printf("%-28s %7zu triangles, %.1f bytes each, %.2f triangles per node, stack of %u\n", address, walk.visits,
                double(hierarchy.bytes()) / double(walk.visits), double(walk.visits) / double(hierarchy.nodes.size()),
                hierarchy.stack);
  }
}

TEST(Hierarchy, with_a_box_that_is_too_small_is_found_out) {
  Hierarchy hierarchy = built(*make_recipe_from_address("recipe:cornell"));
  ASSERT_FALSE(hierarchy.nodes.empty());
  for (float& high : hierarchy.nodes.back().high_y) high -= 1e-3f;
  EXPECT_GT(walk_of(hierarchy).outside, 0u);
}

TEST(Hierarchy, of_no_or_one_triangle_has_no_nodes) {
  Scene scene;
  scene.materials.resize(1);
  EXPECT_EQ(built(scene).root, kNothing);
  scene.meshes = {triangle_of({0, 0, 0}, {0, 0, 0}, {1, 2, 3})};
  EXPECT_EQ(built(scene).root, kNothing) << "nothing meets a triangle without area";
  scene.meshes.push_back(triangle_of({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  const Hierarchy one = built(scene);
  EXPECT_TRUE(one.nodes.empty());
  EXPECT_EQ(one.root, kLeaf);
  EXPECT_EQ(one.triangles.at(0).mesh, 1u);
}

// Each triangle is half as large as the one before and lies in its corner: no split divides them evenly.
TEST(Hierarchy, of_the_most_uneven_triangles_is_not_too_deep) {
  Scene scene;
  scene.materials.resize(1);
  for (int i = -60; i < 60; ++i) {
    const float size = std::ldexp(1.0f, i);
    for (int copy = 0; copy < 8; ++copy) {
      scene.meshes.push_back(triangle_of({size, 0, 0}, {0, size, 0}, {size, size, size * float(copy)}));
    }
  }
  const Hierarchy hierarchy = built(scene);
  const Walk walk = walk_of(hierarchy);
  EXPECT_EQ(walk.triangles.size(), hierarchy.triangles.size());
  EXPECT_EQ(walk.outside, 0u);
  EXPECT_EQ(walk.most_waiting, hierarchy.stack);
  EXPECT_LE(hierarchy.stack, kTraceStack);
}

TEST(Hierarchy, refuses_triangles_without_vertices) {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes = {triangle_of({0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
  scene.meshes[0].indices[2] = 3;
  const Result<Hierarchy> refused = build_hierarchy(scene);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_scene);
}

}  // namespace
}  // namespace luciole
