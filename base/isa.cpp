// SPDX-License-Identifier: Apache-2.0
#include "base/isa.h"

#include "equations/cpp/instruction_set.h"

namespace luciole {
namespace {

bool processor_has(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return supports(InstructionSet::avx512);
    case Isa::avx2:
      return supports(InstructionSet::avx2);
    default:
      return true;
  }
}

}  // namespace

std::string to_string(Isa value) { return name_of(value); }

Result<Isa> choose_isa(Isa wanted) {
  if (wanted == Isa::automatic) {
    for (const Isa isa : {Isa::avx512, Isa::avx2}) {
      if (processor_has(isa)) return isa;
    }
    return Isa::baseline;
  }
  if (processor_has(wanted)) return wanted;
  return Error{ErrorKind::failed, "this processor cannot run the instruction set " + to_string(wanted)};
}

}  // namespace luciole
