// SPDX-License-Identifier: Apache-2.0
// Boxes for tests about whole scenes.
#pragma once
#include <algorithm>
#include <cstdint>

#include "scene/scene.h"

namespace luciole::test {

// inwards: the fronts of its faces are seen from inside.
inline void add_box(Scene& scene, Vec3 low, Vec3 high, bool inwards) {
  if (scene.materials.empty()) scene.materials.emplace_back();
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  }
  constexpr std::uint32_t kQuads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& quad : kQuads) {
    for (const int corner : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(quad[corner]);
  }
  if (inwards) std::reverse(mesh.indices.begin(), mesh.indices.end());
  scene.meshes.push_back(mesh);
}

}  // namespace luciole::test
