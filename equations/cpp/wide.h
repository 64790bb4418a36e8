// SPDX-License-Identifier: Apache-2.0
// luciole::<instruction set>: every equation over one SIMD register. The file that includes this is compiled for one
// instruction set (-mavx512..., -mavx2 -mfma, or none) and names its namespace in LUCIOLE_ISA: avx512, avx2, baseline.
// All code of such a file lives in that namespace, so that the linker can never merge a function compiled for AVX-512
// into a path for older processors.
#pragma once
#include <immintrin.h>

#include <cstdint>

#if !defined(LUCIOLE_ISA)
#error "Define LUCIOLE_ISA as avx512, avx2 or baseline before including equations/cpp/wide.h."
#endif

#define LUCIOLE_FN inline __attribute__((always_inline))
#define LUCIOLE_REAL(literal) real(static_cast<float>(literal))
#define LUCIOLE_INSTANTIATING_EQUATIONS
namespace luciole::LUCIOLE_ISA {
// In the order of dependence, which is not that of the alphabet.
// clang-format off
#include "equations/cpp/wide_types.inc"
#include "equations/cpp/vector_types.inc"
#include "equations/cpp/all_equations.inc"
// clang-format on
}  // namespace luciole::LUCIOLE_ISA
#undef LUCIOLE_INSTANTIATING_EQUATIONS
