// SPDX-License-Identifier: Apache-2.0
// One call for all instruction sets: picks the kernel compiled for the set that the frame runs with.
#pragma once
#include <utility>

#include "real_time/settings.h"

// LUCIOLE_FOR_ISA(isa, shade_group(group, list, true, out)) calls luciole::avx512::shade_group(...), and so on.
#define LUCIOLE_FOR_ISA(isa, call)                           \
  ((isa) == ::luciole::Isa::avx512 ? ::luciole::avx512::call \
   : (isa) == ::luciole::Isa::avx2 ? ::luciole::avx2::call   \
                                   : ::luciole::baseline::call)
