// SPDX-License-Identifier: Apache-2.0
// Numbers that look random and are a function of (seed, index, dimension) alone, so that a recipe makes the same scene
// on every machine and in any order.
#pragma once
#include <cstdint>

namespace luciole::workshop {

// Integer finaliser with full avalanche (two multiplications, three shifts).
inline std::uint32_t mix_bits(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

inline std::uint32_t hash(std::uint32_t seed, std::uint32_t index, std::uint32_t dimension) {
  return mix_bits(mix_bits(mix_bits(seed + 0x9e3779b9u) + index) + dimension * 0x85ebca6bu);
}

// Uniform in [0,1).
inline float unit_hash(std::uint32_t seed, std::uint32_t index, std::uint32_t dimension) {
  return static_cast<float>(hash(seed, index, dimension) >> 8) * 0x1p-24f;
}

}  // namespace luciole::workshop
