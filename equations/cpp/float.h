// SPDX-License-Identifier: Apache-2.0
// luciole::f32: every equation over float, one value at a time.
#pragma once
#include "equations/cpp/float_types.h"

#define LUCIOLE_FN inline
#define LUCIOLE_REAL(literal) static_cast<real>(literal)
#define LUCIOLE_INSTANTIATING_EQUATIONS
namespace luciole::f32 {
#include "equations/cpp/all_equations.inc"
}  // namespace luciole::f32
#undef LUCIOLE_INSTANTIATING_EQUATIONS
#undef LUCIOLE_REAL
#undef LUCIOLE_FN
