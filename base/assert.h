// SPDX-License-Identifier: Apache-2.0
// Assertions for mistakes of ours: they print both values and end the program. On in debug builds and in every test
// build (LUCIOLE_ASSERTIONS).
#pragma once
#include <cstdio>
#include <cstdlib>

#if defined(LUCIOLE_ASSERTIONS)
#define LUCIOLE_ASSERT_COMPARE_(a, op, b)                                                                  \
  do {                                                                                                     \
    const auto luciole_a_ = (a);                                                                           \
    const auto luciole_b_ = (b);                                                                           \
    if (!(luciole_a_ op luciole_b_)) {                                                                     \
      std::fprintf(stderr, "%s:%d: %s " #op " %s does not hold: %.9g, %.9g\n", __FILE__, __LINE__, #a, #b, \
                   static_cast<double>(luciole_a_), static_cast<double>(luciole_b_));                      \
      std::abort();                                                                                        \
    }                                                                                                      \
  } while (false)
#else
#define LUCIOLE_ASSERT_COMPARE_(a, op, b) \
  do {                                    \
  } while (false)
#endif
#define LUCIOLE_ASSERT_LE(a, b) LUCIOLE_ASSERT_COMPARE_(a, <=, b)
#define LUCIOLE_ASSERT_LT(a, b) LUCIOLE_ASSERT_COMPARE_(a, <, b)
#define LUCIOLE_ASSERT_EQ(a, b) LUCIOLE_ASSERT_COMPARE_(a, ==, b)
#define LUCIOLE_ASSERT_GT(a, b) LUCIOLE_ASSERT_COMPARE_(a, >, b)
