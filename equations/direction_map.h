// SPDX-License-Identifier: Apache-2.0
// Area-preserving maps from the unit square to directions: equal cells of the square become equal solid angles, so that
// every texel of a light's map carries the same share of the sphere or cone.
#ifndef LUCIOLE_DIRECTION_MAP_H
#define LUCIOLE_DIRECTION_MAP_H
#include "equations/shading_language.h"

// Cosine and sine of t pi / 4, by their series: the first terms left out are 2e-9. Libraries differ in the last bit,
// and GLSL's may err 2^-11.
//   t  in [-1, 1]
LUCIOLE_FN real2 eighth_turn(real t) {
  const real a = t * LUCIOLE_REAL(0.785398163397448310), a_sq = a * a;
  const real s3 = 1.0f - a_sq * LUCIOLE_REAL(0.0138888888888888889);              // 1 / (8 9)
  const real s2 = 1.0f - a_sq * LUCIOLE_REAL(0.0238095238095238095) * s3;         // 1 / (6 7)
  const real s1 = 1.0f - a_sq * LUCIOLE_REAL(0.05) * s2;                          // 1 / (4 5)
  const real sine = a * (1.0f - a_sq * LUCIOLE_REAL(0.166666666666666667) * s1);  // 1 / (2 3)
  const real c4 = 1.0f - a_sq * LUCIOLE_REAL(0.0111111111111111111);              // 1 / (9 10)
  const real c3 = 1.0f - a_sq * LUCIOLE_REAL(0.0178571428571428571) * c4;         // 1 / (7 8)
  const real c2 = 1.0f - a_sq * LUCIOLE_REAL(0.0333333333333333333) * c3;         // 1 / (5 6)
  const real c1 = 1.0f - a_sq * LUCIOLE_REAL(0.0833333333333333333) * c2;         // 1 / (3 4)
  return real2(1.0f - a_sq * 0.5f * c1, sine);
}

// The sign of the second number on the first, which is not negative.
LUCIOLE_FN real with_sign(real size, real sign) { return select(sign < 0.0f, -size, size); }

// The whole sphere, as an octahedron unfolded onto the square.        [Clarberg 2008] "Fast Equal-Area Mapping of the
// (Hemi)Sphere using SIMD", journal of graphics tools 13(3)
//   square   [0,1]^2
//   returns  unit direction; the square's centre is +z, its corners -z
LUCIOLE_FN real3 octahedral_direction(real2 square) {
  const real a = 2.0f * square.x - 1.0f, b = 2.0f * square.y - 1.0f;
  const real height = 1.0f - (abs(a) + abs(b));  // positive inside the diamond: upper hemisphere
  const real radius = 1.0f - abs(height);        // 0 at a pole, 1 at the equator
  // The position along the side of the diamond is the azimuth, a quarter turn per side, counted from its middle.
  const real2 turn = eighth_turn((abs(b) - abs(a)) / max(radius, LUCIOLE_REAL(1e-30)));
  const real sine = radius * sqrt(2.0f - radius * radius) * LUCIOLE_REAL(0.707106781186547524);  // z = 1 - radius^2
  return real3(with_sign((turn.x - turn.y) * sine, a), with_sign((turn.x + turn.y) * sine, b),
               with_sign(1.0f - radius * radius, height));
}

// A cone round +z: concentric squares become circles [Shirley, Chiu 1997], circles of the disc become circles of the
// cap with the height falling as the radius squared (Lambert's azimuthal projection).
//   square     [0,1]^2
//   cos_outer  cosine of the cone's half angle
//   returns    unit direction with z >= cos_outer
LUCIOLE_FN real3 cone_direction(real2 square, real cos_outer) {
  const real a = 2.0f * square.x - 1.0f, b = 2.0f * square.y - 1.0f;
  const mask sideways = abs(a) > abs(b);
  const real radius = select(sideways, a, b), other = select(sideways, b, a);
  const real2 turn = eighth_turn(other / with_sign(max(abs(radius), LUCIOLE_REAL(1e-30)), radius));
  const real fall = radius * radius * (1.0f - cos_outer);  // 1 - z
  const real sine = with_sign(sqrt(fall * (2.0f - fall)), radius);
  return real3(select(sideways, turn.x, turn.y) * sine, select(sideways, turn.y, turn.x) * sine, 1.0f - fall);
}

#endif
