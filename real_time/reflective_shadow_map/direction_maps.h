// SPDX-License-Identifier: Apache-2.0
// Area-preserving maps from the unit square to directions: equal cells of the square become equal solid angles, so that
// every texel of a light's map carries the same share of the sphere or cone.
#pragma once
#include "base/vector.h"

namespace luciole {

// The whole sphere, as an octahedron unfolded onto the square.        [Clarberg 2008] "Fast Equal-Area Mapping of the
// (Hemi)Sphere using SIMD", journal of graphics tools 13(3)
//   point    [0,1]^2
//   returns  unit direction; the square's centre is +z, its corners -z
Vec3 octahedral_direction(Vec2 point);

// A cone round +z: concentric squares become circles [Shirley, Chiu 1997], circles of the disc become circles of the
// cap with the height falling as the radius squared (Lambert's azimuthal projection).
//   point      [0,1]^2
//   cos_outer  cosine of the cone's half angle
//   returns    unit direction with z >= cos_outer
Vec3 cone_direction(Vec2 point, float cos_outer);

// Two unit vectors perpendicular to a unit vector and to each other; right-handed: cross(right, up) = axis.
struct Basis {
  Vec3 right, up, axis;
  Vec3 world(Vec3 local) const { return right * local.x + up * local.y + axis * local.z; }
};
Basis frame_around(Vec3 axis);

}  // namespace luciole
