// SPDX-License-Identifier: Apache-2.0
// Scalar float and wide float compute the same, on every instruction set that this processor has.
#include <cstring>
#include <string>
#include <vector>

#include "equations/cpp/instruction_set.h"
#include "equations/test_support.h"
#include "equations/wide_test_kernel.h"

#define LUCIOLE_FN inline
#define LUCIOLE_REAL(literal) static_cast<real>(literal)
#define LUCIOLE_INSTANTIATING_EQUATIONS
namespace luciole::f32 {
#include "equations/equations_probe.h"
}

namespace luciole::test {

using Kernel = void (*)(const ProbeColumns&, ProbeResults&);
constexpr const char* kFieldNames[ProbeResults::kFields] = {
    "xi",           "stratified_xi",   "specular",      "diffuse",   "probability",     "range_sq",
    "spheroid_r_u", "fitted_r_w",      "tight_r_u",     "tight_r_w", "box_distance_sq", "exact_distance_sq",
    "touches",      "level_of_detail", "shading_normal"};

ProbeColumns random_columns(Dice& dice) {
  ProbeColumns in;
  for (int i = 0; i < ProbeColumns::kCount; ++i) {
    TextbookLobe lobe = random_lobe(dice, 0.05);
    const f32::real3 incident = rounded(lobe.incident), outgoing = rounded(outgoing_direction(dice, lobe));
    in.incident[0][i] = incident.x, in.incident[1][i] = incident.y, in.incident[2][i] = incident.z;
    in.outgoing[0][i] = outgoing.x, in.outgoing[1][i] = outgoing.y, in.outgoing[2][i] = outgoing.z;
    in.ggx_alpha[i] = static_cast<float>(lobe.alpha), in.f0[i] = static_cast<float>(lobe.f0);
    in.index[i] = dice.bits();
  }
  return in;
}

void probe_scalar(const ProbeColumns& in, ProbeResults& out) {
  for (int i = 0; i < ProbeColumns::kCount; ++i) {
    f32::ProbeInput input;
    input.incident = {in.incident[0][i], in.incident[1][i], in.incident[2][i]};
    input.outgoing = {in.outgoing[0][i], in.outgoing[1][i], in.outgoing[2][i]};
    input.ggx_alpha = in.ggx_alpha[i], input.f0 = in.f0[i], input.index = in.index[i];
    const f32::ProbeOutput o = f32::probe_equations(input);
    static_assert(sizeof(o) == ProbeResults::kFields * sizeof(float));
    float fields[ProbeResults::kFields];
    std::memcpy(fields, &o, sizeof(o));
    for (int f = 0; f < ProbeResults::kFields; ++f) out.field[f][i] = fields[f];
  }
}

struct Deviation {
  double relative[ProbeResults::kFields] = {};
  int changed_bits[ProbeResults::kFields] = {};
  int count = 0;
};

Deviation deviation_of(Kernel kernel) {
  Dice dice(61);
  Deviation d;
  for (int batch = 0; batch < 1000; ++batch) {
    const ProbeColumns in = random_columns(dice);
    ProbeResults expected, result;
    probe_scalar(in, expected);
    kernel(in, result);
    for (int f = 0; f < ProbeResults::kFields; ++f)
      for (int i = 0; i < ProbeColumns::kCount; ++i) {
        // The diffuse part vanishes where Fresnel reaches 1: there its error counts against the part itself at 1/pi.
        const float a = expected.field[f][i], b = result.field[f][i];
        d.changed_bits[f] += std::memcmp(&a, &b, sizeof(float)) != 0;
        d.relative[f] = std::max<double>(d.relative[f], std::abs(a - b) / (std::abs(a) + (f == 3 ? 1e-2f : 1e-6f)));
      }
    d.count += ProbeColumns::kCount;
  }
  return d;
}

void expect_same(InstructionSet set, Kernel kernel) {
  if (!supports(set)) GTEST_SKIP() << "this processor has no " << name_of(set);
  const Deviation d = deviation_of(kernel);
  // Units in the last place: how often rounding differs (fused or not, approximate inverse) along each chain, amplified
  // where directions cancel at ggx_alpha >= .05. The tight ellipsoid may keep another of two equally good candidates.
  // Random numbers are equal bit for bit, decisions but for ties.
  const double limit[ProbeResults::kFields] = {0,    0,    5e-6, 5e-6, 5e-6, 5e-6, 5e-6, 5e-6,
                                               2e-3, 2e-3, 5e-3, 5e-3, 100,  5e-7, 2e-6};
  for (int f = 0; f < ProbeResults::kFields; ++f) {
    EXPECT_LE(d.relative[f], limit[f]) << kFieldNames[f];
    ::testing::Test::RecordProperty(kFieldNames[f], std::to_string(d.relative[f]));
  }
  EXPECT_EQ(d.changed_bits[0], 0);
  EXPECT_EQ(d.changed_bits[1], 0);
  EXPECT_LT(d.changed_bits[12], 0.0005 * d.count) << "decisions differ only at ties";
}

TEST(WideEquations, are_the_scalar_ones_on_avx512) { expect_same(InstructionSet::avx512, avx512::probe); }
TEST(WideEquations, are_the_scalar_ones_on_avx2) { expect_same(InstructionSet::avx2, avx2::probe); }
TEST(WideEquations, are_the_scalar_ones_on_baseline) { expect_same(InstructionSet::baseline, baseline::probe); }

TEST(WideEquations, with_one_lane_misplaced_are_caught) {
  const Deviation d = deviation_of([](const ProbeColumns& in, ProbeResults& out) {
    probe_scalar(in, out);
    for (auto& field : out.field) std::swap(field[3], field[4]);
  });
  EXPECT_GT(d.changed_bits[0], 0);
  EXPECT_GT(d.relative[2], 1e-2);
}

}  // namespace luciole::test
