// SPDX-License-Identifier: Apache-2.0
// The random numbers of one pixel: Owen-scrambled Sobol' points, two dimensions at a time, every pair shuffled and
// scrambled by itself. A function of (seed, pixel, sample, dimension) without state; any run of 2^k samples that starts
// at a multiple of 2^k is spread as evenly in each pair as two dimensions allow.
// B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
#pragma once
#include <cstdint>

#include "base/vector.h"
#include "equations/cpp/float.h"

namespace luciole {

// A hash in the form of a nested uniform scramble of bits in reverse order: a bit changes those above it only.
inline std::uint32_t scramble_reversed(std::uint32_t bits, std::uint32_t seed) {
  bits += seed;
  bits ^= bits * 0x6c50b47cu;
  bits ^= bits * 0xb82f1e52u;
  bits ^= bits * 0xc7afe638u;
  bits ^= bits * 0x8d22f6e6u;
  return bits;
}

// Point `index` of the second dimension of Sobol's sequence, its bits in reverse order: Pascal's triangle modulo 2,
// factored into five steps.
inline std::uint32_t second_sobol_reversed(std::uint32_t index) {
  index ^= (index & 0xaaaaaaaau) >> 1u;
  index ^= (index & 0xccccccccu) >> 2u;
  index ^= (index & 0xf0f0f0f0u) >> 4u;
  index ^= (index & 0xff00ff00u) >> 8u;
  return index ^ ((index & 0xffff0000u) >> 16u);
}

class SampleSequence {
 public:
  SampleSequence(std::uint32_t seed, std::uint32_t pixel, std::uint64_t sample)
      : key_(f32::random_words(seed, static_cast<std::uint32_t>(sample >> 32u), pixel, kStream)),
        sample_reversed_(f32::reverse_bits(static_cast<std::uint32_t>(sample))) {}

  // Two numbers in (0,1). The next call gives another, independent pair.
  Vec2 pair() {
    const f32::RandomWords words = pair_of_words();
    return {f32::unit_real(words.first), f32::unit_real(words.second)};
  }
  // The same as whole numbers, for choices among more than a float can tell apart.
  f32::RandomWords pair_of_words() {
    const std::uint32_t a = mixed(key_.first + 0x9e3779b9u * ++dimension_);
    const std::uint32_t index = f32::reverse_bits(scramble_reversed(sample_reversed_, a));
    const std::uint32_t x = scramble_reversed(index, mixed(a ^ key_.second));
    const std::uint32_t y = scramble_reversed(second_sobol_reversed(index), mixed(a + 0x68bc21ebu));
    return {f32::reverse_bits(x), f32::reverse_bits(y)};
  }
  // 32 bits without the order of the pairs.
  std::uint32_t bits() {
    return mixed(mixed(key_.second + 0x85ebca6bu * ++dimension_) ^ f32::reverse_bits(sample_reversed_));
  }

 private:
  static constexpr std::uint32_t kStream = 32;  // dimension of random_words that no other user asks for

  // A bijection that spreads every bit over all others.
  static std::uint32_t mixed(std::uint32_t x) {
    x ^= x >> 16u, x *= 0x21f0aaadu;
    x ^= x >> 15u, x *= 0xd35a2d97u;
    return x ^ (x >> 15u);
  }

  f32::RandomWords key_;
  std::uint32_t sample_reversed_, dimension_ = 0;
};

}  // namespace luciole
