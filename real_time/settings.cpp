// SPDX-License-Identifier: Apache-2.0
#include "real_time/settings.h"

#include "real_time/setting_names.h"

namespace luciole {

std::string to_string(BoundingVolume value) { return name_of(value); }
std::string to_string(TileTest value) { return name_of(value); }
std::string to_string(Culling value) { return name_of(value); }
std::string to_string(Ranges value) { return name_of(value); }
std::string to_string(NearField value) { return name_of(value); }
std::string to_string(Filter value) { return name_of(value); }
std::string to_string(Isa value) { return name_of(value); }

namespace {

// What the kernels of each path are compiled for (cmake/isa.cmake). The compiler's run-time library also asks whether
// the operating system saves the registers.
bool processor_has(Isa isa) {
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  switch (isa) {
    case Isa::avx512:
      return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    case Isa::avx2:
      return avx2;
    default:
      return true;
  }
#else
  return isa == Isa::baseline || isa == Isa::automatic;
#endif
}

}  // namespace

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
