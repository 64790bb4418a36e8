// SPDX-License-Identifier: Apache-2.0
// Lets rays pass through the holes of alpha-masked meshes, and through blended ones.
#pragma once
#include <cstdint>

#include "ray_tracing/embree_version.h"
#include "scene/scene.h"

namespace luciole {

struct AlphaFilter {
  const Scene* scene;
  std::uint32_t mesh;
  bool blend_at_random = false;

  // Has the geometry ask this filter about every candidate hit. The filter must outlive the geometry.
  void attach(RTCGeometry geometry);
};

}  // namespace luciole
