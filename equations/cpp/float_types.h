// SPDX-License-Identifier: Apache-2.0
// luciole::f32: the language of the equations over float, one value at a time.
#pragma once
#include <cmath>
#include <cstdint>

#define LUCIOLE_FN inline
namespace luciole::f32 {
using real = float;
// In the order of dependence, which is not that of the alphabet.
// clang-format off
#include "equations/cpp/scalar_functions.inc"
#include "equations/cpp/vector_types.inc"
// clang-format on
}  // namespace luciole::f32
#undef LUCIOLE_FN
