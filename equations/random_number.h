// SPDX-License-Identifier: Apache-2.0
// Random numbers without state: a function of who asks and when. Integers only, until the last step, so that every
// language and every machine draws the same bits.
#ifndef LUCIOLE_RANDOM_NUMBER_H
#define LUCIOLE_RANDOM_NUMBER_H
#include "equations/shading_language.h"

struct RandomWords {
  uint_ first;
  uint_ second;
};

struct EncryptionKey {
  uint_ a, b, c, d;
};

// Tiny encryption algorithm, which [TH16] sect. 4.4 uses for its random numbers.   [Zafar et al. 2010]
//   words    plain text: a counter of two words, for example light index and frame
//   key      the same for all words of one stream
//   rounds   32 is the full cipher; 8 passes the usual tests of randomness
//   returns  64 bits that look random, a bijection of `words`
LUCIOLE_FN RandomWords tiny_encryption(RandomWords words, EncryptionKey key, int rounds) {
  uint_ sum = 0u;
  for (int i = 0; i < rounds; ++i) {
    sum += 0x9e3779b9u;
    words.first += ((words.second << 4u) + key.a) ^ (words.second + sum) ^ ((words.second >> 5u) + key.b);
    words.second += ((words.first << 4u) + key.c) ^ (words.first + sum) ^ ((words.first >> 5u) + key.d);
  }
  return words;
}

// The random bits of one light, pixel or path in one frame.
//   seed       user's choice
//   frame      frame or pass
//   index      of the light (its texel, never its place in a compacted list) or of the pixel
//   dimension  which number of this index: lobe, bounce, ...
//   returns    64 uniform bits
LUCIOLE_FN RandomWords random_words(uint_ seed, uint_ frame, uint_ index, uint_ dimension) {
  RandomWords words;
  words.first = index;
  words.second = frame;
  EncryptionKey key;  // the constants are those of [Zafar et al. 2010], so that seed 0 is as good as any other
  key.a = uint_(0xa341316cu) ^ seed;
  key.b = uint_(0xc8013ea4u) + dimension;
  key.c = uint_(0xad90777du) + seed;
  key.d = uint_(0x7e95761eu) ^ dimension;
  return tiny_encryption(words, key, 8);
}

// A number in (0,1) from 32 random bits.
//   returns  (bits + 1/2) / 2^32, rounded to `real`, at most 1 - 2^-24: never 0, which would be an infinite range, and
//            never 1. All products are exact, so the sum rounds alike with and without fused multiply-add.
LUCIOLE_FN real unit_real(uint_ bits) {
  const real coarse = real_from_uint(bits >> 8u) * 5.9604644775390625e-8f;                 // 2^-24
  const real fine = (real_from_uint(bits & 255u) + 0.5f) * 2.3283064365386962890625e-10f;  // 2^-32
  return min(coarse + fine, LUCIOLE_REAL(0.999999940395355224609375));                     // 1 - 2^-24
}

// The bits of a light's second lobe. Uniform like the first, and xi(second) = 1 - xi(first): where the two acceptance
// probabilities sum to less than 1, accepting one lobe excludes the other, which is the least variance that two
// separate bounds allow.
LUCIOLE_FN uint_ complement_bits(uint_ bits) { return bits ^ 0xffffffffu; }

// 32 bits in reverse order: bits of the radical inverse in base 2 (van der Corput).
LUCIOLE_FN uint_ reverse_bits(uint_ bits) {
  uint_ b = ((bits >> 1u) & 0x55555555u) | ((bits & 0x55555555u) << 1u);
  b = ((b >> 2u) & 0x33333333u) | ((b & 0x33333333u) << 2u);
  b = ((b >> 4u) & 0x0f0f0f0fu) | ((b & 0x0f0f0f0fu) << 4u);
  b = ((b >> 8u) & 0x00ff00ffu) | ((b & 0x00ff00ffu) << 8u);
  return (b >> 16u) | (b << 16u);
}

// Random bits that are stratified over the lights: neighbours in space get far-apart numbers, and any run of 2^k lights
// along the Morton curve gets one number in each of 2^k equal strata. Each light's number alone is uniform, because the
// shift is: so the estimate stays unbiased, while the count of accepted lights varies less.
//   morton_rank  the light's place along the Morton curve (morton_code)
//   shift        32 random bits, the same for all lights of a frame
//   returns      uniform bits, for unit_real
LUCIOLE_FN uint_ stratified_bits(uint_ morton_rank, uint_ shift) { return reverse_bits(morton_rank) + shift; }

// Moves the 10 low bits apart, two zeros between neighbours.
LUCIOLE_FN uint_ spread_bits(uint_ bits) {
  uint_ b = bits & 0x3ffu;
  b = (b | (b << 16u)) & 0x030000ffu;
  b = (b | (b << 8u)) & 0x0300f00fu;
  b = (b | (b << 4u)) & 0x030c30c3u;
  return (b | (b << 2u)) & 0x09249249u;
}

// Place of a cell along the Morton curve through a 1024^3 grid.
//   x, y, z  cell coordinates, 0 ... 1023
LUCIOLE_FN uint_ morton_code(uint_ x, uint_ y, uint_ z) {
  return spread_bits(x) | (spread_bits(y) << 1u) | (spread_bits(z) << 2u);
}

#endif
