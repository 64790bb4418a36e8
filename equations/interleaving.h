// SPDX-License-Identifier: Apache-2.0
// Interleaved sampling: the picture is n x n sub-regions, each of every n-th pixel, and each sees its own n^2-th of the
// lights, weighted n^2.                                                [TH16] sect. 4.2, [TH17] sect. 6
#ifndef LUCIOLE_INTERLEAVING_H
#define LUCIOLE_INTERLEAVING_H
#include "equations/shading_language.h"

// Sub-region of a pixel.
//   x, y      pixel
//   log2_n    0, 1, 2, 3: n = 1, 2, 4, 8, the same for all pixels of a picture
//   returns   0 ... n^2 - 1
LUCIOLE_FN uint_ sub_region_of_pixel(uint_ x, uint_ y, uint_ log2_n) {
  const uint_ low_bits = shift_left(uint_(1u), log2_n) - uint_(1u);
  return shift_left(y & low_bits, log2_n) | (x & low_bits);
}

// The subset of lights that a sub-region sees in this frame. A light belongs to subset (index mod n^2).
//   shift    random bits, the same for all sub-regions of a frame: with a fixed subset a pixel would see the same
//   lights
//            for every seed, and its mean would not be that of all lights
//   returns  0 ... n^2 - 1
LUCIOLE_FN uint_ light_subset(uint_ sub_region, uint_ shift, uint_ log2_n) {
  return (sub_region + shift) & (shift_left(uint_(1u), log2_n + log2_n) - uint_(1u));
}

// What a light of the subset counts: n^2. Its acceptance probability is that of the light alone, not n^2 times it.
LUCIOLE_FN real interleaving_weight(uint_ log2_n) { return real_from_uint(shift_left(uint_(1u), log2_n + log2_n)); }

#endif
