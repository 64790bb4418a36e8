// SPDX-License-Identifier: Apache-2.0
// A scene's triangles in a bounding volume hierarchy of plain records, for ray casters of devices. Embree builds it and
// stays behind this door.
#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "ray_tracing/hierarchy_records.h"
#include "scene/scene.h"

namespace luciole {

struct Hierarchy {
  std::vector<HierarchyNode> nodes;          // depth first: a child lies behind its parent
  std::vector<HierarchyTriangle> triangles;  // leaf after leaf; those without area are left out, as no ray meets them
  std::uint32_t root = kNothing;             // reference; kNothing where there is no triangle
  std::uint32_t stack = 0;                   // most references that can wait on a way down, at most kTraceStack

  std::uint64_t bytes() const {
    return nodes.size() * sizeof(HierarchyNode) + triangles.size() * sizeof(HierarchyTriangle);
  }
};

// Fails with out_of_memory, with bad_scene where a triangle refers to a vertex that does not exist, and where there are
// more than 2^28 triangles.
Result<Hierarchy> build_hierarchy(const Scene& scene);

}  // namespace luciole
