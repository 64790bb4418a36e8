// SPDX-License-Identifier: Apache-2.0
// Lets rays pass through the holes of alpha-masked meshes.
#pragma once
#include <cstdint>

#include "ray_tracing/embree_version.h"
#include "scene/scene.h"

namespace luciole {

struct AlphaFilter {
  const Scene* scene;
  std::uint32_t mesh;

  // Has the geometry ask this filter about every candidate hit. The filter must outlive the geometry.
  void attach(RTCGeometry geometry);
};

}  // namespace luciole
