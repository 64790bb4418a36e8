// SPDX-License-Identifier: Apache-2.0
// luciole::counting: every equation over a number that counts what is done with it. The floor of a device is what it
// needs for these operations alone.
#pragma once
#include <cmath>
#include <cstdint>

#define LUCIOLE_FN inline
#define LUCIOLE_REAL(literal) real(static_cast<float>(literal))
#define LUCIOLE_INSTANTIATING_EQUATIONS
namespace luciole::counting {

struct Operations {
  std::uint64_t simple = 0;   // additions, multiplications, comparisons, minima: a multiply-add is two
  std::uint64_t special = 0;  // divisions, roots, logarithms
};
inline Operations counted;

struct real {
  float value = 0;
  real() = default;
  real(float v) : value(v) {}  // NOLINT(google-explicit-constructor): literals convert, as in shaders
};
using mask = bool;
using uint_ = std::uint32_t;

inline real simple(float value) {
  ++counted.simple;
  return value;
}
inline real special(float value) {
  ++counted.special;
  return value;
}
inline mask compared(mask value) {
  ++counted.simple;
  return value;
}

inline real operator+(real a, real b) { return simple(a.value + b.value); }
inline real operator-(real a, real b) { return simple(a.value - b.value); }
inline real operator*(real a, real b) { return simple(a.value * b.value); }
inline real operator/(real a, real b) { return special(a.value / b.value); }
inline real operator-(real a) { return -a.value; }  // folded into what follows
inline real& operator+=(real& a, real b) { return a = a + b; }
inline real& operator-=(real& a, real b) { return a = a - b; }
inline real& operator*=(real& a, real b) { return a = a * b; }
inline mask operator<(real a, real b) { return compared(a.value < b.value); }
inline mask operator>(real a, real b) { return compared(a.value > b.value); }
inline mask operator<=(real a, real b) { return compared(a.value <= b.value); }
inline mask operator>=(real a, real b) { return compared(a.value >= b.value); }

inline real sqrt(real x) { return special(std::sqrt(x.value)); }
inline real inverse_sqrt(real x) { return special(1 / std::sqrt(x.value)); }
inline real inverse(real x) { return special(1 / x.value); }
inline real log2(real x) { return special(std::log2(x.value)); }
inline real abs(real x) { return std::abs(x.value); }  // folded, too
inline real floor(real x) { return simple(std::floor(x.value)); }
inline real min(real a, real b) { return simple(a.value < b.value ? a.value : b.value); }
inline real max(real a, real b) { return simple(a.value > b.value ? a.value : b.value); }
inline real clamp(real x, real low, real high) { return min(max(x, low), high); }
inline real mix(real a, real b, real t) { return a + (b - a) * t; }
inline real select(mask m, real a, real b) { return simple(m ? a.value : b.value); }
inline real real_from_uint(uint_ u) { return simple(static_cast<float>(u)); }
inline uint_ uint_from_real(real x) { return static_cast<uint_>(simple(x.value).value); }
inline uint_ shift_left(uint_ bits, uint_ by) { return bits << by; }
inline uint_ shift_right(uint_ bits, uint_ by) { return bits >> by; }

// In the order of dependence, which is not that of the alphabet.
// clang-format off
#include "equations/cpp/vector_types.inc"
#include "equations/cpp/all_equations.inc"
// clang-format on
}  // namespace luciole::counting
#undef LUCIOLE_INSTANTIATING_EQUATIONS
#undef LUCIOLE_REAL
#undef LUCIOLE_FN
