// SPDX-License-Identifier: Apache-2.0
// The probe (equations_probe.h) over whole registers, once per instruction set.
#pragma once
#include <cstdint>

namespace luciole {

struct ProbeColumns {
  static constexpr int kCount = 16;  // a multiple of every register's lanes
  alignas(64) float incident[3][kCount], outgoing[3][kCount], ggx_alpha[kCount], f0[kCount];
  alignas(64) std::uint32_t index[kCount];
};
struct ProbeResults {
  static constexpr int kFields = 15;
  alignas(64) float field[kFields][ProbeColumns::kCount];  // in the order of ProbeOutput
};

namespace avx512 {
void probe(const ProbeColumns& in, ProbeResults& out);
}
namespace avx2 {
void probe(const ProbeColumns& in, ProbeResults& out);
}
namespace baseline {
void probe(const ProbeColumns& in, ProbeResults& out);
}

}  // namespace luciole
