// SPDX-License-Identifier: Apache-2.0
// The mistake that check_symbols.cmake must catch: an inline function outside the namespace of the instruction set.
namespace luciole {
inline __attribute__((noinline)) float leaked(float x) { return x * x + 1.0f; }
namespace LUCIOLE_ISA {
float leak(float x) { return leaked(x); }
}  // namespace LUCIOLE_ISA
}  // namespace luciole
