// SPDX-License-Identifier: Apache-2.0
// luciole::f64: every equation over double, for tests and for whatever must be exact.
#pragma once
#include <cmath>
#include <cstdint>

#define LUCIOLE_FN inline
#define LUCIOLE_REAL(literal) static_cast<real>(literal)
#define LUCIOLE_INSTANTIATING_EQUATIONS
namespace luciole::f64 {
using real = double;
// In the order of dependence, which is not that of the alphabet.
// clang-format off
#include "equations/cpp/scalar_functions.inc"
#include "equations/cpp/vector_types.inc"
#include "equations/cpp/all_equations.inc"
// clang-format on
}  // namespace luciole::f64
#undef LUCIOLE_INSTANTIATING_EQUATIONS
#undef LUCIOLE_REAL
#undef LUCIOLE_FN
