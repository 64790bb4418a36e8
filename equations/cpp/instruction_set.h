// SPDX-License-Identifier: Apache-2.0
// Which of the wide instantiations this processor can run. Must not be included by files compiled for an instruction
// set of their own (luciole_isa_sources): it is the caller's choice.
#pragma once

namespace luciole {

enum class InstructionSet { baseline, avx2, avx512 };

// The compiler's builtin also asks whether the operating system saves the registers.
inline bool supports(InstructionSet set) {
#if defined(__x86_64__)
  switch (set) {
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("fma");
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case InstructionSet::baseline:
      return true;
  }
  return false;
#else
  return set == InstructionSet::baseline;
#endif
}

inline InstructionSet widest_instruction_set() {
  if (supports(InstructionSet::avx512)) return InstructionSet::avx512;
  return supports(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::baseline;
}

// The name of its namespace, and of --isa.
inline const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::avx2:
      return "avx2";
    default:
      return "baseline";
  }
}

}  // namespace luciole
