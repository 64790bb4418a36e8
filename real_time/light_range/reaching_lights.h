// SPDX-License-Identifier: Apache-2.0
// Door: lights with this frame's random number and the volume that it lets them reach. One entry per lobe, ordered by
// interleaving subset: a light stands in subset key mod n^2, in the order of the pass's input.
#pragma once
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"

namespace luciole {

// What the shading kernels read of a light: broadcast to all pixels of a group. Plain floats, so that the file for each
// instruction set can read it. `probability_scale` is E / delta times the intensity's constant part, largest channel:
// p = min(probability_scale * g(w_o) / (l^2 + disc), 1).
struct alignas(32) DiffuseEmitter {
  float position[3], normal[3], geometric_normal[3];
  float incident[3];   // w_i
  float intensity[3];  // flux * diffuse albedo; times (1 - F) cos / pi it is the radiant intensity [W/sr]
  float probability_scale;
  float xi;           // this frame's random number; 0: always accepted
  float disc;         // A / pi of the near field [m^2]
  float f0_max, f90;  // Fresnel loss (KHR_materials_specular)
};

struct alignas(32) GlossyEmitter {
  float position[3], normal[3], geometric_normal[3];
  float incident[3];
  float flux[3];            // Phi [W]
  float probability_scale;  // E / delta: the largest channel of flux * F varies with direction
  float xi;
  float disc;
  float f0[3];
  float f90;
  float alpha_sq, cos_incident, masking;  // FixedDirectionBrdf
};

struct alignas(32) ManyEmitter {
  float position[3], axis[3];
  float intensity[3];
  float probability_scale;
  float xi;
  float disc;
  float scale, offset, two_sided, squared;  // many_lights.h
};

// What the culling kernels read of 16 lights, one per lane: the prepared ellipsoid of equations/tile_test.h, in view
// space (right, up, forward). The first four rows reject most lights; the others are read only where they do not.
struct alignas(64) BoundBlock {
  enum Row : int {
    kCentreX,
    kCentreY,
    kCentreZ,
    kRadius,  // sphere around the ellipsoid; radius < 0: reaches nothing  [m]
    kM00,
    kM01,
    kM02,
    kM11,
    kM12,
    kM22,  // TriangularFactor                                          [1/m]
    kStretchedX,
    kStretchedY,
    kStretchedZ,  // M centre
    kNormalX,
    kNormalY,
    kNormalZ,
    kNormalOffset,  // SurfacePlane
    kSxx,
    kSxz,
    kSyy,
    kSyz,
    kSzz,  // Sigma                                                     [m^2]
    kRows,
    // For the paper's tile test instead: the rows of B S and the stretched centre (equations/paper_tile_test.h).
    kPaper = kM00
  };
  float row[kRows][16];
};

// Lights of one kind. Subset s holds lobes [begin[s], begin[s] + count[s]); begin is a multiple of 16, and the lanes
// between the subsets reach nothing.
template <class Emitter>
struct ReachingLights {
  AlignedVector<Emitter> emitters;
  AlignedVector<BoundBlock> bounds;  // block b holds lights 16 b ... 16 b + 15
  std::vector<std::uint32_t> begin, count;
};

}  // namespace luciole
