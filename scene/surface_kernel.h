// SPDX-License-Identifier: Apache-2.0
// evaluate_surface for 16 hits of one mesh at once; compiled once per instruction set. evaluate_surface is the
// definition: the two agree to a few roundings (surface_kernel_test.cpp).
#pragma once
#include <cstdint>

#include "scene/surface_tables.h"

namespace luciole {

inline constexpr int kSurfaceLanes = 16;

// All lanes are evaluated: those that nobody asks about repeat another one.
struct alignas(64) SurfaceQueries {
  std::uint32_t triangle[kSurfaceLanes];     // of the mesh
  float u[kSurfaceLanes], v[kSurfaceLanes];  // barycentric: point = (1-u-v) p0 + u p1 + v p2
  float ray_direction[3][kSurfaceLanes];     // from the viewer to the surface, any length but 0
  float cone_width[kSurfaceLanes];           // diameter of the ray cone at the hit [m]; 0: finest level
};

// The members of SurfacePoint that a renderer of opaque surfaces asks for.
struct alignas(64) SurfaceAnswers {
  float position[3][kSurfaceLanes];
  float geometric_normal[3][kSurfaceLanes], shading_normal[3][kSurfaceLanes];
  float diffuse_albedo[3][kSurfaceLanes], f0[3][kSurfaceLanes];
  float f90[kSurfaceLanes], ggx_alpha[kSurfaceLanes];
  float emission[3][kSurfaceLanes];
};

#define LUCIOLE_DECLARE_SURFACE_KERNEL(isa)                                                                \
  namespace luciole::isa {                                                                                 \
  void evaluate_surfaces(const SurfaceMesh& mesh, const SurfaceQueries& queries, SurfaceAnswers& answers); \
  }
}  // namespace luciole
LUCIOLE_DECLARE_SURFACE_KERNEL(avx512)
LUCIOLE_DECLARE_SURFACE_KERNEL(avx2)
LUCIOLE_DECLARE_SURFACE_KERNEL(baseline)
#undef LUCIOLE_DECLARE_SURFACE_KERNEL
