// SPDX-License-Identifier: Apache-2.0
#include "equations/wide_test_kernel.h"

#include "equations/cpp/wide.h"

#define LUCIOLE_INSTANTIATING_EQUATIONS
namespace luciole::LUCIOLE_ISA {
#include "equations/equations_probe.h"

void probe(const ProbeColumns& in, ProbeResults& out) {
  for (int i = 0; i < ProbeColumns::kCount; i += kLanes) {
    ProbeInput input;
    input.incident = real3(load(in.incident[0] + i), load(in.incident[1] + i), load(in.incident[2] + i));
    input.outgoing = real3(load(in.outgoing[0] + i), load(in.outgoing[1] + i), load(in.outgoing[2] + i));
    input.ggx_alpha = load(in.ggx_alpha + i);
    input.f0 = load(in.f0 + i);
    input.index = load(in.index + i);
    const ProbeOutput o = probe_equations(input);
    const real fields[ProbeResults::kFields] = {
        o.xi,           o.stratified_xi,   o.specular,      o.diffuse,   o.probability,     o.range_sq,
        o.spheroid_r_u, o.fitted_r_w,      o.tight_r_u,     o.tight_r_w, o.box_distance_sq, o.exact_distance_sq,
        o.touches,      o.level_of_detail, o.shading_normal};
    for (int f = 0; f < ProbeResults::kFields; ++f) store(out.field[f] + i, fields[f]);
  }
}

}  // namespace luciole::LUCIOLE_ISA
