// SPDX-License-Identifier: Apache-2.0
// Which instruction set the kernels run with (cmake/isa.cmake), and one call for all of them.
#pragma once
#include <cstdint>
#include <string>

#include "base/name_table.h"
#include "base/result.h"

namespace luciole {

enum class Isa : std::uint8_t { automatic, avx512, avx2, baseline };

constexpr NameTable<Isa, 4> names(Isa) {
  return {{{Isa::automatic, "auto"}, {Isa::avx512, "avx512"}, {Isa::avx2, "avx2"}, {Isa::baseline, "baseline"}}};
}
std::string to_string(Isa);

// The fastest instruction set of this processor, or the one asked for; failed if the processor lacks it.
Result<Isa> choose_isa(Isa wanted);

}  // namespace luciole

// LUCIOLE_FOR_ISA(isa, shade_group(group, list, true, out)) calls luciole::avx512::shade_group(...), and so on.
#define LUCIOLE_FOR_ISA(isa, call)                           \
  ((isa) == ::luciole::Isa::avx512 ? ::luciole::avx512::call \
   : (isa) == ::luciole::Isa::avx2 ? ::luciole::avx2::call   \
                                   : ::luciole::baseline::call)
