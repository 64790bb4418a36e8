// SPDX-License-Identifier: Apache-2.0
#include "ray_tracing/check_indices.h"

#include <string>

namespace luciole {

Status check_indices(const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size();
  for (const std::uint32_t index : mesh.indices) {
    if (index >= vertices) {
      return Error{ErrorKind::bad_scene, "mesh '" + mesh.name + "' refers to vertex " + std::to_string(index) +
                                             " but has " + std::to_string(vertices)};
    }
  }
  return Done{};
}

}  // namespace luciole
